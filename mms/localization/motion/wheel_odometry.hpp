#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <optional>
#include <vector>

#include "mms/core/motion_samples.hpp"

namespace mms {

/// Recent dead reckoning of the wheels.
class WheelOdometry {
 public:
  /// Motion of the base between two times.
  struct Motion {
    Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity();
    double way = 0.0;   ///< length of the path [m]
    double turn = 0.0;  ///< sum of all turns [rad]
  };

  /// Measurements that do not follow the last one are left out.
  /// @param delay  of their stamps
  void add(const std::vector<WheelSample>& samples, Duration delay);

  /// Without measurements around both times, or with a gap between them: nothing. Shortly after the
  /// last measurement, the base is expected to move on.
  /// @param shift  added to both times
  std::optional<Motion> between(Timestamp from, Timestamp to, Duration shift = Duration(0)) const;

  bool empty() const { return samples_.empty(); }

 private:
  std::optional<Eigen::Isometry3d> pose_at(Timestamp stamp) const;

  std::deque<WheelSample> samples_;
};

}  // namespace mms
