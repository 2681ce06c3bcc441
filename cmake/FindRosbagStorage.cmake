# Debian's librosbag-storage-dev as the target rosbag_storage_library. Its own CMake package
# defines no targets and omits pluginlib's headers, which its headers include.
set(required)
foreach(header rosbag/bag.h pluginlib/class_loader.hpp class_loader/class_loader.hpp
        rcpputils/shared_library.hpp rcutils/macros.h ament_index_cpp/get_resource.hpp
        console_bridge/console.h boost/shared_ptr.hpp)
  string(REGEX REPLACE "/.*" "" package ${header})
  find_path(RosbagStorage_${package}_INCLUDE_DIR ${header} PATH_SUFFIXES ${package})
  mark_as_advanced(RosbagStorage_${package}_INCLUDE_DIR)
  list(APPEND required RosbagStorage_${package}_INCLUDE_DIR)
endforeach()
foreach(library rosbag_storage roscpp_serialization rostime cpp_common class_loader console_bridge)
  find_library(RosbagStorage_${library}_LIBRARY ${library})
  mark_as_advanced(RosbagStorage_${library}_LIBRARY)
  list(APPEND required RosbagStorage_${library}_LIBRARY)
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(RosbagStorage REQUIRED_VARS ${required})
if(RosbagStorage_FOUND AND NOT TARGET rosbag_storage_library)
  add_library(rosbag_storage_library INTERFACE IMPORTED)
  foreach(variable IN LISTS required)
    if(variable MATCHES "_LIBRARY$")
      target_link_libraries(rosbag_storage_library INTERFACE ${${variable}})
    elseif(NOT ${variable} STREQUAL "/usr/include")
      target_include_directories(rosbag_storage_library SYSTEM INTERFACE ${${variable}})
    endif()
  endforeach()
endif()
