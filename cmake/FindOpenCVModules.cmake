# Debian splits OpenCV: the CMake package comes only with libopencv-dev and half a gigabyte of
# dependencies. This finds the few modules we need with or without it, as opencv_<module> targets.

find_package(OpenCV 4 QUIET CONFIG COMPONENTS ${OpenCVModules_FIND_COMPONENTS})
if(NOT OpenCV_FOUND)
  find_path(OpenCVModules_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
  set(required OpenCVModules_INCLUDE_DIR)
  foreach(module IN LISTS OpenCVModules_FIND_COMPONENTS)
    find_library(OpenCVModules_${module}_LIBRARY opencv_${module})
    list(APPEND required OpenCVModules_${module}_LIBRARY)
    if(OpenCVModules_${module}_LIBRARY AND NOT TARGET opencv_${module})
      add_library(opencv_${module} SHARED IMPORTED)
      set_target_properties(opencv_${module} PROPERTIES
        IMPORTED_LOCATION "${OpenCVModules_${module}_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${OpenCVModules_INCLUDE_DIR}")
    endif()
  endforeach()
  include(FindPackageHandleStandardArgs)
  find_package_handle_standard_args(OpenCVModules REQUIRED_VARS ${required})
else()
  set(OpenCVModules_FOUND TRUE)
endif()
