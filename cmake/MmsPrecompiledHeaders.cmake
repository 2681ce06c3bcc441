# Headers that most sources include, read once a folder of targets instead of once a source.
option(MMS_PRECOMPILED_HEADERS "Precompile the headers of Eigen and the standard library" ON)

set(mms_common_headers
  <algorithm> <array> <chrono> <cmath> <cstddef> <cstdint> <filesystem> <functional> <limits> <map>
  <memory> <numeric> <optional> <span> <string> <string_view> <utility> <vector>
  <Eigen/Core> <Eigen/Geometry>)

# mms_precompile(TARGET [HEADER...]): precompiles the common headers and those given for a target.
function(mms_precompile target)
  if(MMS_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE ${mms_common_headers} ${ARGN})
  endif()
endfunction()

# mms_share_precompiled(TARGET OTHER): TARGET uses what was precompiled for OTHER, whose compiler
# flags are the same.
function(mms_share_precompiled target other)
  if(MMS_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM ${other})
  endif()
endfunction()
