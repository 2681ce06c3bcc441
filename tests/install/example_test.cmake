# Builds an example against the package that install_test.cmake installed, as a user would, runs it
# and compares its output with a regular expression.
#
#   cmake -DEXAMPLE=FOLDER -DARGUMENT=... -DEXPECTED=REGEX -DWORK_DIR=... -DCXX_FLAGS=...
#         -P example_test.cmake

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/step.cmake)
cmake_path(GET EXAMPLE FILENAME name)
set(work ${WORK_DIR}/${name})

file(REMOVE_RECURSE ${work})
file(COPY ${EXAMPLE}/ DESTINATION ${work}/source)
set(clean_environment ${CMAKE_COMMAND} -E env --unset=CMAKE_PREFIX_PATH --unset=CPATH
                      --unset=CMAKE_MODULE_PATH)
step("configure" ${clean_environment} ${CMAKE_COMMAND} -S ${work}/source -B ${work}/build
                 -DCMAKE_PREFIX_PATH=${WORK_DIR}/moved -DCMAKE_BUILD_TYPE=Release
                 "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" -G Ninja)
step("build" ${clean_environment} ${CMAKE_COMMAND} --build ${work}/build)
step("run" ${work}/build/${name} ${ARGUMENT})
if(NOT output MATCHES "${EXPECTED}")
  message(FATAL_ERROR "unexpected output of examples/${name}:\n${output}")
endif()
