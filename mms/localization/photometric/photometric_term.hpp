#pragma once

#include <array>
#include <cstdint>

#include "mms/geometry/depth_noise.hpp"
#include "mms/geometry/normal_equations.hpp"
#include "mms/localization/features/feature_cloud.hpp"
#include "mms/localization/photometric/intensity_keyframe.hpp"
#include "mms/localization/photometric/photometric_config.hpp"

namespace mms {

/// Exposure change between two images, current = gain * keyframe + bias, and the spread of the
/// residuals left [grey levels]; both re-estimated in every iteration.
struct PhotometricState {
  double gain = 1.0;
  double bias = 0.0;
  double sigma = 12.0;
};

/// Sums over one keyframe's points, for the step and for the state of the next iteration.
struct PhotometricEquations {
  NormalEquations equations;
  int visible = 0;                             ///< points that fell on a consistent static pixel
  std::array<std::uint32_t, 128> histogram{};  ///< of |residual|, one grey level a bin
  double sw = 0.0, sk = 0.0, sc = 0.0, skk = 0.0, skc = 0.0;  ///< weighted moments for the gain

  PhotometricEquations& operator+=(const PhotometricEquations& other);
  PhotometricState next(const PhotometricState& now, double min_sigma) const;
};

/// Photometric residuals of a keyframe's points in the current image, beyond the paper:
/// r = I(pi(T^-1 T_k p)) - (gain I_k + bias), weighted by a t-distribution (Kerl et al., ICRA
/// 2013). A point counts only where the current frame has a static depth that agrees with it: parts
/// of a person that the masks miss are in front of the point and exclude it.
PhotometricEquations photometric_equations(const IntensityKeyframe& keyframe, std::size_t level,
                                           const IntensityLevel& current,
                                           const Eigen::Isometry3d& T_world_sensor,
                                           const PhotometricState& state,
                                           const PhotometricConfig& config,
                                           const DepthNoise& noise);

}  // namespace mms
