# Install rules: find_package(mms) gives the targets mms::core, mms::geometry, ... mms::pipeline.

include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/mms)

get_property(modules GLOBAL PROPERTY MMS_MODULES)
if(TARGET mms_torch)
  list(APPEND modules mms_torch)
endif()
install(TARGETS ${modules} mms_build_settings EXPORT mms_targets)
install(DIRECTORY mms DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(EXPORT mms_targets NAMESPACE mms:: DESTINATION ${package_dir})
configure_package_config_file(cmake/mms-config.cmake.in ${PROJECT_BINARY_DIR}/mms-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mms-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mms-config.cmake ${PROJECT_BINARY_DIR}/mms-config-version.cmake
              cmake/FindOpenCVModules.cmake cmake/FindRosbagStorage.cmake
        DESTINATION ${package_dir})
if(TARGET mms_program)
  install(TARGETS mms_program)
  if(TARGET mms_torch_program)
    install(TARGETS mms_torch_program)
  endif()
  install(FILES weights/nano.safetensors weights/small.safetensors
          DESTINATION ${CMAKE_INSTALL_DATADIR}/mms/weights)
endif()
