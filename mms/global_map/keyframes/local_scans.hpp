#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"

namespace mms {

/// The static points of the last LiDAR keyframes, put together by the odometry.
class LocalScans {
 public:
  /// Adds the next keyframe, and forgets those that the path since is too long for.
  /// @param cloud  as if all its points were measured at its stamp
  void add(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor);

  /// Forgets all, as the motion since is not known.
  void clear() { scans_.clear(); }

  /// All points, in the sensor frame of the last keyframe [m].
  std::vector<Eigen::Vector3f> points() const;

 private:
  struct Scan {
    Eigen::Isometry3d T_world_sensor;
    double path = 0.0;                    // up to here [m]
    std::vector<Eigen::Vector3f> points;  // in its sensor frame [m]
  };

  std::deque<Scan> scans_;
};

}  // namespace mms
