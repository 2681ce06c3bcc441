#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mms/geometry/depth_noise.hpp"
#include "mms/localization/features/feature_cloud.hpp"
#include "mms/localization/photometric/photometric_config.hpp"

namespace mms {

/// Position and intensity of a static pixel with texture.
struct TexturedPoint {
  Eigen::Vector3f point;  ///< in the keyframe's sensor frame [m]
  float intensity;        ///< [0, 255]
};

/// Textured points that later frames are compared with photometrically.
struct IntensityKeyframe {
  Eigen::Isometry3d T_world_sensor = Eigen::Isometry3d::Identity();
  std::vector<std::vector<TexturedPoint>> levels;  ///< finest first
  double depth = 1.0;  ///< harmonic mean of the points' depths, the scale of parallax [m]
};

/// Takes the strongest gradient of every cell of `cell_px` pixels, where the surface is static and
/// continuous; its depth is averaged over the pixels around it on the same surface.
IntensityKeyframe make_intensity_keyframe(const std::vector<IntensityLevel>& levels,
                                          const Eigen::Isometry3d& T_world_sensor,
                                          const PhotometricConfig& config, const DepthNoise& noise);

}  // namespace mms
