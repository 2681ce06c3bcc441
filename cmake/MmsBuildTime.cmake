# Shorter first builds: precompiled headers and unity builds.
option(MMS_PRECOMPILED_HEADERS "Precompile the headers of Eigen and the standard library" ON)

set(mms_common_headers
  <algorithm> <array> <chrono> <cmath> <cstddef> <cstdint> <filesystem> <functional> <limits> <map>
  <memory> <numeric> <optional> <span> <string> <string_view> <utility> <vector>
  <Eigen/Core> <Eigen/Geometry>)

# mms_precompile(TARGET [HEADER...]): precompiles the common and the given headers for a target.
function(mms_precompile target)
  if(MMS_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE ${mms_common_headers} ${ARGN})
  endif()
endfunction()

# mms_share_precompiled(TARGET OTHER): TARGET uses the precompiled headers of OTHER, which must have
# the same compiler flags.
function(mms_share_precompiled target other)
  if(MMS_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM ${other})
  endif()
endfunction()

option(MMS_UNITY_BUILD "Compile several sources at a time in targets with expensive headers" ON)

# mms_unity(TARGET [SIZE]): compiles the sources of TARGET in groups of SIZE (default: 8). For targets
# whose headers take longer than their code; not for those that compute poses or maps, where it could
# change the last bits.
function(mms_unity target)
  if(MMS_UNITY_BUILD)
    set(size 8)
    if(ARGC GREATER 1)
      set(size ${ARGV1})
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
  endif()
endfunction()
