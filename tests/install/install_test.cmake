# Installs the build, checks that what is installed knows nothing of where it was built, and builds
# and runs examples/minimal against it as a user would.
#
#   cmake -DBUILD_DIR=... -DSOURCE_DIR=... -DWORK_DIR=... -DCXX_FLAGS=... -P install_test.cmake

cmake_minimum_required(VERSION 3.25)
set(prefix ${WORK_DIR}/prefix)

function(step description)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${description} failed (${result}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
file(COPY ${SOURCE_DIR}/examples/minimal DESTINATION ${WORK_DIR})
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
set(clean_environment ${CMAKE_COMMAND} -E env --unset=CMAKE_PREFIX_PATH --unset=CPATH
                      --unset=CMAKE_MODULE_PATH)
step("configure" ${clean_environment} ${CMAKE_COMMAND} -S ${WORK_DIR}/minimal -B ${WORK_DIR}/build
                 -DCMAKE_PREFIX_PATH=${WORK_DIR}/moved -DCMAKE_BUILD_TYPE=Release
                 "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" -G Ninja)
step("build" ${clean_environment} ${CMAKE_COMMAND} --build ${WORK_DIR}/build)
step("run" ${WORK_DIR}/build/minimal "sim:corridor?frames=3&width=320")
if(NOT output MATCHES "tracking\n.*static map: [1-9][0-9]* points")
  message(FATAL_ERROR "unexpected output of examples/minimal:\n${output}")
endif()
if(EXISTS ${WORK_DIR}/moved/bin/mms)
  step("run the program" ${WORK_DIR}/moved/bin/mms --version)
endif()
