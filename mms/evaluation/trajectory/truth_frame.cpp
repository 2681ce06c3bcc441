#include "mms/evaluation/trajectory/truth_frame.hpp"

#include <vector>

#include "mms/evaluation/trajectory/alignment.hpp"
#include "mms/evaluation/trajectory/stamp_matching.hpp"
#include "mms/evaluation/trajectory/trajectory_error.hpp"

namespace mms {

std::optional<Eigen::Isometry3d> align_truth(const Trajectory& truth, const Trajectory& estimate) {
  const auto matched = match_by_stamp(truth, estimate, TrajectoryErrorOptions{}.max_difference);
  if (matched.empty()) return std::nullopt;
  std::vector<Eigen::Isometry3d> true_poses;
  std::vector<Eigen::Isometry3d> poses;
  for (const PoseMatch& match : matched) {
    true_poses.push_back(truth[match.reference].T_world_sensor.isometry());
    poses.push_back(estimate[match.estimate].T_world_sensor.isometry());
  }
  return align_poses(true_poses, poses);
}

Trajectory poses_without(Trajectory poses, const std::set<Timestamp>& left_out) {
  std::erase_if(poses, [&](const StampedPose& pose) { return left_out.contains(pose.stamp); });
  return poses;
}

}  // namespace mms
