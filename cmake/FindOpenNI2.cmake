# OpenNI2 as the target openni2_library.
find_path(OpenNI2_INCLUDE_DIR OpenNI.h PATH_SUFFIXES openni2)
find_library(OpenNI2_LIBRARY OpenNI2)
mark_as_advanced(OpenNI2_INCLUDE_DIR OpenNI2_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenNI2 REQUIRED_VARS OpenNI2_LIBRARY OpenNI2_INCLUDE_DIR)
if(OpenNI2_FOUND AND NOT TARGET openni2_library)
  add_library(openni2_library INTERFACE IMPORTED)
  target_link_libraries(openni2_library INTERFACE ${OpenNI2_LIBRARY})
  target_include_directories(openni2_library SYSTEM INTERFACE ${OpenNI2_INCLUDE_DIR})
endif()
