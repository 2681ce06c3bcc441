# Eclipse Cyclone DDS as the target cyclonedds_library. Its own CMake package also asks for the tools.
find_path(Cyclonedds_INCLUDE_DIR dds/ddsi/ddsi_serdata.h)
find_library(Cyclonedds_LIBRARY ddsc)
mark_as_advanced(Cyclonedds_INCLUDE_DIR Cyclonedds_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Cyclonedds REQUIRED_VARS Cyclonedds_LIBRARY Cyclonedds_INCLUDE_DIR)
if(Cyclonedds_FOUND AND NOT TARGET cyclonedds_library)
  add_library(cyclonedds_library INTERFACE IMPORTED)
  target_link_libraries(cyclonedds_library INTERFACE ${Cyclonedds_LIBRARY})
  target_include_directories(cyclonedds_library SYSTEM INTERFACE ${Cyclonedds_INCLUDE_DIR})
endif()
