# mms_pictures_by_stb(TARGET): adds the image reader without OpenCV.
function(mms_pictures_by_stb target)
  find_path(STB_INCLUDE_DIR stb_image.h PATH_SUFFIXES stb)
  if(NOT STB_INCLUDE_DIR)
    message(FATAL_ERROR "stb_image.h was not found: install libstb-dev, or give STB_INCLUDE_DIR")
  endif()
  target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/mms/io/stb/stb_picture.cpp)
  target_include_directories(${target} SYSTEM PRIVATE ${STB_INCLUDE_DIR})
endfunction()
