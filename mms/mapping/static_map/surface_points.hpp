#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/core/config_visitor.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/geometry/sensor_noise.hpp"
#include "mms/mapping/static_map/intensity_grey.hpp"

namespace mms {

struct SurfaceConfig {
  double max_depth = 6.0;     ///< [m]
  double max_range = 1000.0;  ///< [m]
  double max_jump = 0.05;     ///< [m]
  double boundary = 0.01;     ///< share of the image's width
  SensorNoise noise{};        ///< no setting of its own: `SystemConfig::noise`

  void visit(ConfigVisitor& v) {
    v.number({"max_depth", "m", "farthest point of a depth image that is mapped"}, max_depth,
             {0.1, 1000.0});
    v.number({"max_range", "m", "farthest point of a LiDAR scan that is mapped"}, max_range,
             {0.1, 1e5});
    v.number(
        {"max_jump", "m", "jump of depth between neighboring pixels of one surface, above noise"},
        max_jump, {0.0, 10.0});
    v.number({"boundary", "",
              "width left out around dynamic pixels, as a share of the image's width", "rim"},
             boundary, {0.0, 0.5});
  }
};

/// A static point for the map, in the sensor frame.
struct SurfacePoint {
  Eigen::Vector3f point;                             ///< [m]
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, towards the sensor; zero if unknown
  float weight = 1.0F;                               ///< 1 / variance, 1 at the least noise
  Rgb color = kNoColor;
};

/// Weight of a point whose depth has that noise [m].
inline float noise_weight(float sigma, const DepthNoise& noise) {
  const float ratio = static_cast<float>(noise.base) / sigma;
  return ratio * ratio;
}

/// The static points of `cloud` within range. Of an organised cloud without those at a depth
/// discontinuity, where a pixel averages two surfaces (flying pixels), and those beside dynamic
/// pixels, where masks miss parts of feet and colours blur.
/// @param step  only every `step`-th row and column of an organised cloud is used
std::vector<SurfacePoint> surface_points(const LabeledCloud& cloud, const SurfaceConfig& config,
                                         int step = 1);

}  // namespace mms
