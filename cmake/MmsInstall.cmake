# Install rules. find_package(mms) gives the targets mms::core, mms::geometry, ... mms::pipeline.
# Components: development (headers, libraries, CMake package), program (mms and its files), torch,
# ros and python (what needs libtorch, roscpp and Python).

include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/mms)

get_property(modules GLOBAL PROPERTY MMS_MODULES)
if(TARGET mms_torch)
  list(APPEND modules mms_torch)
endif()
install(TARGETS ${modules} mms_build_settings EXPORT mms_targets COMPONENT development)
install(DIRECTORY mms DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.hpp")
install(EXPORT mms_targets NAMESPACE mms:: DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(cmake/mms-config.cmake.in ${PROJECT_BINARY_DIR}/mms-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mms-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mms-config.cmake ${PROJECT_BINARY_DIR}/mms-config-version.cmake
              cmake/FindOpenCVModules.cmake cmake/FindRecordingLibraries.cmake
              cmake/FindLibav.cmake cmake/FindLibpcap.cmake cmake/FindCyclonedds.cmake cmake/FindOpenNI2.cmake
        DESTINATION ${package_dir} COMPONENT development)

if(TARGET mms_program)
  include(${CMAKE_CURRENT_LIST_DIR}/MmsSbom.cmake)
  mms_write_sbom(${PROJECT_BINARY_DIR}/mms.cdx.json)
  install(FILES ${PROJECT_BINARY_DIR}/mms.cdx.json DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/mms-slam
          COMPONENT program)
  install(TARGETS mms_program COMPONENT program)
  install(FILES weights/nano.safetensors weights/everyday.safetensors
          DESTINATION ${CMAKE_INSTALL_DATADIR}/mms/weights COMPONENT program)
  install(DIRECTORY config DESTINATION ${CMAKE_INSTALL_DATADIR}/mms COMPONENT program)
  install(FILES packaging/mms.bash-completion RENAME mms
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
  install(FILES packaging/mms.zsh-completion RENAME _mms
          DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
  # The program prints its manual page and default settings; when cross-compiling it needs an emulator.
  if(NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR)
    add_custom_command(
      OUTPUT ${PROJECT_BINARY_DIR}/mms.1.gz ${PROJECT_BINARY_DIR}/default.yaml
      DEPENDS mms_program packaging/make_man_page.sh
      COMMAND ${PROJECT_SOURCE_DIR}/packaging/make_man_page.sh ${PROJECT_BINARY_DIR}
              ${PROJECT_VERSION} ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:mms_program>)
    add_custom_target(mms_program_files ALL
      DEPENDS ${PROJECT_BINARY_DIR}/mms.1.gz ${PROJECT_BINARY_DIR}/default.yaml)
    install(FILES ${PROJECT_BINARY_DIR}/mms.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
            COMPONENT program)
    install(FILES ${PROJECT_BINARY_DIR}/default.yaml
            DESTINATION ${CMAKE_INSTALL_DATADIR}/mms/config COMPONENT program)
  endif()
endif()
if(TARGET mms_torch_program)
  install(TARGETS mms_torch_program COMPONENT torch)
endif()
