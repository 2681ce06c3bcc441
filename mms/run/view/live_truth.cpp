#include "mms/run/view/live_truth.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include "mms/evaluation/trajectory/trajectory_error.hpp"

namespace mms {

LiveTruth::LiveTruth(Trajectory truth) : truth_(std::move(truth)) {
  std::erase_if(truth_, [](const StampedPose& pose) { return !pose.T_world_sensor.is_finite(); });
  std::sort(truth_.begin(), truth_.end(),
            [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
}

std::optional<Eigen::Vector3d> LiveTruth::at(const StampedPose& estimate) {
  const auto later =
      std::lower_bound(truth_.begin(), truth_.end(), estimate.stamp,
                       [](const StampedPose& pose, Timestamp stamp) { return pose.stamp < stamp; });
  const StampedPose* nearest = later == truth_.end() ? nullptr : &*later;
  if (later != truth_.begin()) {
    const StampedPose& earlier = *std::prev(later);
    const bool is_nearer =
        nearest == nullptr || estimate.stamp - earlier.stamp < nearest->stamp - estimate.stamp;
    if (is_nearer) nearest = &earlier;
  }
  if (nearest == nullptr) return std::nullopt;
  const auto difference = std::chrono::abs(nearest->stamp - estimate.stamp);
  if (difference > TrajectoryErrorOptions{}.max_difference) return std::nullopt;
  const Eigen::Isometry3d& pose = nearest->T_world_sensor.isometry();
  if (!T_world_truth_) T_world_truth_ = estimate.T_world_sensor.isometry() * pose.inverse();
  return *T_world_truth_ * pose.translation();
}

}  // namespace mms
