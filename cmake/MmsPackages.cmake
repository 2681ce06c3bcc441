# Debian packages by cpack, from any build without libtorch: mms-slam (program, weights, settings,
# manual page, bash and zsh completion), libmms-dev (headers, static libraries, CMake package) and
# python3-mms-slam (Python module), where that is built.
if(NOT PROJECT_IS_TOP_LEVEL OR NOT TARGET mms_program OR MMS_WITH_TORCH)
  return()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME mms-slam)
set(CPACK_PACKAGE_VENDOR "MMS-SLAM contributors")
set(CPACK_PACKAGE_CONTACT "MMS-SLAM contributors <maintainers@mms-slam.invalid>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each component has its own
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program development)
if(TARGET mms_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME mms-slam)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"visual and LiDAR SLAM among moving people and vehicles
MMS-SLAM localizes a depth camera or LiDAR among walking people and moving
vehicles. It writes the trajectory of the sensor, a static map without them,
and the tracked objects with boxes and velocities. A simulated warehouse
with exact ground truth and a viewer for the browser are part of it.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmms-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
string(CONCAT CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
       "libeigen3-dev (>= 3.4), libtbb-dev, robin-map-dev, libopencv-core-dev, "
       "libopencv-imgproc-dev, libopencv-imgcodecs-dev, libopencv-dnn-dev, "
       "libopencv-features2d-dev, libpng-dev, libceres-dev, libdnnl-dev, "
       "ocl-icd-opencl-dev, libembree-dev, libyaml-cpp-dev, nlohmann-json3-dev, liboctomap-dev, "
       "libsqlite3-dev, libzstd-dev, liblz4-dev, libbz2-dev, libfmt-dev, libboost-dev (>= 1.74)")
if(Libav_FOUND)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
         ", libavformat-dev, libavcodec-dev, libswscale-dev")
endif()
if(Libpcap_FOUND)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libpcap-dev")
endif()
if(Cyclonedds_FOUND)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", cyclonedds-dev")
endif()
if(OpenNI2_FOUND)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libopenni2-dev")
endif()
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"visual and LiDAR SLAM among moving people and vehicles (development files)
MMS-SLAM localizes a depth camera or LiDAR among walking people and moving
vehicles, and maps what stands still.

This package contains the headers, the static libraries and the CMake
package: find_package(mms).")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-mms-slam)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
# The module is for one version of Python; mms-slam has the weights of the network.
if(TARGET mms_python)
  get_target_property(minor mms_python MMS_PYTHON_MINOR)
  math(EXPR next_minor "${minor} + 1")
  string(CONCAT CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
         "python3 (>= 3.${minor}), python3 (<< 3.${next_minor}), python3-numpy, "
         "mms-slam (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
endif()
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"visual and LiDAR SLAM among moving people and vehicles (Python module)
MMS-SLAM localizes a depth camera or LiDAR among walking people and moving
vehicles, and maps what stands still.

This package contains the module mms_slam for Python 3, with numpy arrays.")

# Files required by Debian policy.
set(changelog ${PROJECT_BINARY_DIR}/changelog.Debian.gz)
execute_process(COMMAND ${PROJECT_SOURCE_DIR}/packaging/make_changelog.sh ${changelog}
                        ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}
                        ${CPACK_PACKAGE_CONTACT}
                COMMAND_ERROR_IS_FATAL ANY)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES ${changelog} packaging/copyright DESTINATION ${folder} COMPONENT ${component})
endforeach()
include(CPack)
