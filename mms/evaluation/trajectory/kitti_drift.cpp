#include "mms/evaluation/trajectory/kitti_drift.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "mms/evaluation/scores/statistics.hpp"
#include "mms/evaluation/trajectory/relative_error.hpp"
#include "mms/geometry/se3.hpp"

namespace mms {
namespace {

constexpr std::array kPartLengths = {100.0, 200.0, 300.0, 400.0,
                                     500.0, 600.0, 700.0, 800.0};  // [m]
constexpr std::size_t kPosesBetweenParts = 10;

/// Length of the true path from the first match to each one [m].
std::vector<double> true_path(const Trajectory& reference, const std::vector<PoseMatch>& matches) {
  std::vector<double> path;
  double length = 0.0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (i > 0) {
      length += (reference[matches[i].reference].T_world_sensor.translation() -
                 reference[matches[i - 1].reference].T_world_sensor.translation())
                    .norm();
    }
    path.push_back(length);
  }
  return path;
}

}  // namespace

KittiDrift kitti_drift(const Trajectory& reference, const Trajectory& estimate,
                       const std::vector<PoseMatch>& matches) {
  const std::vector<double> path = true_path(reference, matches);
  std::vector<double> percents;
  std::vector<double> degrees;
  for (std::size_t first = 0; first < path.size(); first += kPosesBetweenParts) {
    for (const double length : kPartLengths) {
      const auto last = std::upper_bound(path.begin(), path.end(), path[first] + length);
      if (last == path.end()) break;
      const Eigen::Isometry3d error =
          relative_pose_error(reference, estimate, matches[first],
                              matches[static_cast<std::size_t>(last - path.begin())]);
      percents.push_back(100.0 * error.translation().norm() / length);
      degrees.push_back(100.0 * se3::angle(error) * 180.0 / std::numbers::pi / length);
    }
  }
  return {percents.size(), mean(percents), mean(degrees)};
}

std::vector<MetricValue> metric_values(const KittiDrift& drift) {
  return {
      {"kitti_trans_pct", "KITTI drift, translation", drift.trans_pct, "%", 4},
      {"kitti_rot_deg_per_100m", "KITTI drift, rotation", drift.rot_deg_per_100m, "deg/100 m", 4}};
}

}  // namespace mms
