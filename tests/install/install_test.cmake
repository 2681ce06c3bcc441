# Installs the build, and checks that the installed files do not contain the build's path.
#
#   cmake -DBUILD_DIR=... -DSOURCE_DIR=... -DWORK_DIR=... -P install_test.cmake

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/step.cmake)
set(prefix ${WORK_DIR}/prefix)

file(REMOVE_RECURSE ${WORK_DIR})
step("install" ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})

file(GLOB_RECURSE packages ${prefix}/*.cmake)
if(NOT packages)
  message(FATAL_ERROR "no CMake package was installed in ${prefix}")
endif()
foreach(file IN LISTS packages)
  file(READ ${file} text)
  string(REPLACE "${prefix}" "" text "${text}")
  foreach(folder ${BUILD_DIR} ${SOURCE_DIR})
    string(FIND "${text}" "${folder}" found)
    if(NOT found EQUAL -1)
      message(FATAL_ERROR "${file} names the folder ${folder}, which a user does not have")
    endif()
  endforeach()
endforeach()

# The prefix at another place shows that the package can be moved.
file(RENAME ${prefix} ${WORK_DIR}/moved)
if(EXISTS ${WORK_DIR}/moved/bin/mms)
  step("run the program" ${WORK_DIR}/moved/bin/mms --version)
endif()
