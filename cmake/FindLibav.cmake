# FFmpeg's libraries as the target libav_libraries. They have pkg-config files only.
set(required)
foreach(library avformat avcodec avutil swscale)
  find_path(Libav_${library}_INCLUDE_DIR lib${library}/${library}.h)
  find_library(Libav_${library}_LIBRARY ${library})
  mark_as_advanced(Libav_${library}_INCLUDE_DIR Libav_${library}_LIBRARY)
  list(APPEND required Libav_${library}_LIBRARY Libav_${library}_INCLUDE_DIR)
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Libav REQUIRED_VARS ${required})
if(Libav_FOUND AND NOT TARGET libav_libraries)
  add_library(libav_libraries INTERFACE IMPORTED)
  target_link_libraries(libav_libraries INTERFACE ${Libav_avformat_LIBRARY} ${Libav_avcodec_LIBRARY}
                        ${Libav_swscale_LIBRARY} ${Libav_avutil_LIBRARY})
  target_include_directories(libav_libraries SYSTEM INTERFACE ${Libav_avformat_INCLUDE_DIR})
endif()
