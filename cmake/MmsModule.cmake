# Common compiler settings, and one library target per module.
include(${CMAKE_CURRENT_LIST_DIR}/MmsBuildTime.cmake)

add_library(mms_build_settings INTERFACE)
target_compile_features(mms_build_settings INTERFACE cxx_std_20)
target_compile_options(mms_build_settings INTERFACE
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wconversion;-Wshadow;-Werror>)
# gcc 12 warns about inlined code of Eigen and std::string.
set(mms_false_warnings -Wno-maybe-uninitialized -Wno-restrict -Wno-stringop-overflow)
target_compile_options(mms_build_settings INTERFACE
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:${mms_false_warnings}>>
  $<BUILD_INTERFACE:$<$<AND:$<CXX_COMPILER_ID:GNU>,$<NOT:$<CONFIG:Release>>>:-Wno-array-bounds>>)
if(MMS_ARCH STREQUAL "" AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(mms_arch "x86-64-v3")
else()
  set(mms_arch "${MMS_ARCH}")
endif()
if(mms_arch)
  # Part of the interface, because it determines Eigen's alignment.
  target_compile_options(mms_build_settings INTERFACE -march=${mms_arch})
endif()
if(MMS_SANITIZE)
  target_compile_options(mms_build_settings INTERFACE
    $<BUILD_INTERFACE:-fsanitize=${MMS_SANITIZE};-fno-omit-frame-pointer>)
  target_link_options(mms_build_settings INTERFACE $<BUILD_INTERFACE:-fsanitize=${MMS_SANITIZE}>)
  # The thread sanitizer does not see Boost.Asio's fences; its locks order the same accesses.
  if(MMS_SANITIZE MATCHES thread)
    target_compile_options(mms_build_settings INTERFACE $<BUILD_INTERFACE:-Wno-tsan>)
  endif()
endif()

set_property(GLOBAL PROPERTY MMS_MODULES "")

# mms_shareable(TARGET): its objects may become part of a shared library, such as the Python module.
# Without semantic interposition gcc inlines as in programs, so that results are the same bits.
function(mms_shareable target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
endfunction()

# Precompiled headers of all modules.
add_library(mms_precompiled OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
target_link_libraries(mms_precompiled PRIVATE mms_build_settings Eigen3::Eigen)
mms_shareable(mms_precompiled)
mms_precompile(mms_precompiled)

# mms_module(NAME [UNITY] [FOLDER dir] [WITHOUT regex...] [PRECOMPILE header...] [PUBLIC lib...]
# [PRIVATE lib...]): the target mms_NAME (alias mms::NAME) of all sources below mms/NAME, or below
# mms/FOLDER, but those whose path from there begins with one of WITHOUT. A module of headers alone
# becomes an interface library.
function(mms_module name)
  cmake_parse_arguments(ARG "UNITY" "FOLDER" "WITHOUT;PRECOMPILE;PUBLIC;PRIVATE" ${ARGN})
  if(NOT ARG_FOLDER)
    set(ARG_FOLDER ${name})
  endif()
  set(folder ${PROJECT_SOURCE_DIR}/mms/${ARG_FOLDER})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  foreach(part IN LISTS ARG_WITHOUT)
    list(FILTER sources EXCLUDE REGEX "^${folder}/${part}")
  endforeach()
  if(sources)
    add_library(mms_${name} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(mms_${name} PRIVATE ${ARG_PRIVATE})
    mms_shareable(mms_${name})
    if(ARG_PRECOMPILE)
      mms_precompile(mms_${name} ${ARG_PRECOMPILE})
    else()
      mms_share_precompiled(mms_${name} mms_precompiled)
    endif()
    if(ARG_UNITY)
      mms_unity(mms_${name})
    endif()
  else()
    add_library(mms_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(mms::${name} ALIAS mms_${name})
  target_link_libraries(mms_${name} ${scope} ${ARG_PUBLIC} mms_build_settings)
  target_include_directories(mms_${name} SYSTEM ${scope}
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(mms_${name} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  set_target_properties(mms_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY MMS_MODULES mms_${name})
endfunction()
