#pragma once

#include <Eigen/Geometry>
#include <cstddef>

#include "mms/geometry/depth_noise.hpp"
#include "mms/global_map/keyframes/keyframe_view.hpp"

namespace mms {

/// Comparison of the weak texture of surfaces that views share, patch by patch. Equal racks differ
/// in it: by marks on the floor, or by what is behind them.
struct TextureComparison {
  std::size_t patches = 0;    ///< with weak texture in both views
  std::size_t different = 0;  ///< of these, with a negative correlation of the grey values

  TextureComparison& operator+=(const TextureComparison& other);

  /// Share of patches that differ; 0 if there are too few of them. Random textures have 0.5.
  double dissimilarity() const;
};

/// @param T_a_b  from the sensor frame of `b` to that of `a`
/// @returns no patches for views without grey values
TextureComparison compare_textures(const KeyframeView& a, const KeyframeView& b,
                                   const Eigen::Isometry3d& T_a_b, const DepthNoise& noise);

}  // namespace mms
