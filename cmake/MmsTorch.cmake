# libtorch as the target mms_torch, with system headers and without its compiler flags. Debian's
# package is found automatically; another one with -DCMAKE_PREFIX_PATH=.../libtorch.
find_package(Torch QUIET)
if(NOT Torch_FOUND)
  message(FATAL_ERROR "libtorch was not found: install libtorch-dev, give CMAKE_PREFIX_PATH, or "
                      "build without the network with -DMMS_WITH_TORCH=OFF")
endif()
add_library(mms_torch INTERFACE)
target_include_directories(mms_torch SYSTEM INTERFACE ${TORCH_INCLUDE_DIRS})
target_link_libraries(mms_torch INTERFACE ${TORCH_LIBRARIES})
# Training with several processes needs Gloo's headers, which PyTorch's libtorch lacks.
find_path(MMS_GLOO_INCLUDE gloo/rendezvous/store.h HINTS ${TORCH_INCLUDE_DIRS})
if(MMS_GLOO_INCLUDE)
  target_include_directories(mms_torch SYSTEM INTERFACE ${MMS_GLOO_INCLUDE})
  target_compile_definitions(mms_torch INTERFACE MMS_WITH_GLOO USE_C10D_GLOO)
endif()
