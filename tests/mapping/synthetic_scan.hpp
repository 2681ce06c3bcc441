#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"

namespace mms::test {

/// A standing box, by two corners in the world frame [m].
struct StandingBox {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
};

/// Entry of a ray into a box as a multiple of `ray`; infinity without an intersection.
inline double entry(const StandingBox& box, const Eigen::Vector3d& origin,
                    const Eigen::Vector3d& ray) {
  const Eigen::Array3d a = (box.low - origin).array() / ray.array();
  const Eigen::Array3d b = (box.high - origin).array() / ray.array();
  const double enter = a.min(b).maxCoeff();
  return enter > 0.0 && enter <= a.max(b).minCoeff() ? enter : INFINITY;
}

/// A scan of 16 rings, 2 degrees apart, in a hall of 16 x 16 m whose floor is 1 m below the world's
/// origin, with boxes in it. The sensor's z axis is up.
inline LabeledCloud hall_scan(const std::vector<StandingBox>& boxes,
                              const Transform<World, Sensor>& T_world_sensor) {
  const Eigen::Vector3d origin = T_world_sensor.translation();
  LabeledCloud cloud;
  for (int column = 0; column < 900; ++column) {
    for (int ring = 0; ring < 16; ++ring) {
      const double azimuth = (0.4 * column + 0.05) * M_PI / 180.0;
      const double elevation = (-15.0 + 2.0 * ring) * M_PI / 180.0;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const Eigen::Vector3d direction = T_world_sensor.rotation() * ray;
      double range = INFINITY;  // to the walls, the floor and the ceiling, from within
      const Eigen::Vector3d low(-8.0, -8.0, -1.0);
      const Eigen::Vector3d high(8.0, 8.0, 4.0);
      for (int i = 0; i < 3; ++i) {
        range =
            std::min(range, ((direction(i) > 0.0 ? high(i) : low(i)) - origin(i)) / direction(i));
      }
      for (const StandingBox& box : boxes) range = std::min(range, entry(box, origin, direction));
      cloud.points.emplace_back((range * ray).cast<float>());
    }
  }
  cloud.width = static_cast<int>(cloud.points.size());
  cloud.height = 1;
  cloud.labels.assign(cloud.points.size(), PointLabel::kStatic);
  cloud.cluster.assign(cloud.points.size(), -1);
  return cloud;
}

}  // namespace mms::test
