# mms_check_cpu(TARGET...): programs report a processor that is too old for them. Only for levels of
# x86-64 above the first; not with sanitizers, whose runtime is not initialized that early.
set(mms_cpu_example_x86-64-v2 "SSE4.2")
set(mms_cpu_example_x86-64-v3 "AVX2")
set(mms_cpu_example_x86-64-v4 "AVX-512")
set(mms_cpu_fallback_x86-64-v2 "x86-64")
set(mms_cpu_fallback_x86-64-v3 "x86-64-v2")
set(mms_cpu_fallback_x86-64-v4 "x86-64-v3")
if(DEFINED mms_cpu_example_${mms_arch} AND NOT MMS_SANITIZE)
  add_library(mms_cpu_check OBJECT ${PROJECT_SOURCE_DIR}/cmake/cpu_check.cpp)
  target_compile_options(mms_cpu_check PRIVATE -march=x86-64)
  target_compile_definitions(mms_cpu_check PRIVATE
    MMS_CPU_LEVEL="${mms_arch}" MMS_CPU_EXAMPLE="${mms_cpu_example_${mms_arch}}"
    MMS_CPU_FALLBACK="${mms_cpu_fallback_${mms_arch}}")
endif()

function(mms_check_cpu)
  if(TARGET mms_cpu_check)
    foreach(program IN LISTS ARGN)
      target_sources(${program} PRIVATE $<TARGET_OBJECTS:mms_cpu_check>)
    endforeach()
  endif()
endfunction()
