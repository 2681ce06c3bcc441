#pragma once

#include "mms/core/config_visitor.hpp"
#include "mms/core/image.hpp"

namespace mms {

/// Ranges of the numbers of calibration files.
inline constexpr Range kFocalRange{1e-3, 1e5};             ///< [px]
inline constexpr Range kPrincipalPointRange{-1e5, 1e5};    ///< [px]
inline constexpr Range kImageSideRange{1, kMaxImageSide};  ///< [px]
inline constexpr Range kDepthScaleRange{1e-3, 1e6};        ///< [units/m]
inline constexpr Range kMaxDepthRange{0.1, 1000.0};        ///< [m]

}  // namespace mms
