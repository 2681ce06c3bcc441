#include "mms/ros/robot_frame.hpp"

#include <algorithm>

namespace mms {

void RobotFrame::add(const msg::Transforms& message) {
  msg::Transforms others = message;
  const auto is_own = [this](const std::string& frame) { return frame == map_ || frame == world_; };
  std::erase_if(others.transforms, [&](const msg::TransformStamped& transform) {
    return is_own(transform.header.frame_id) || is_own(transform.child_frame_id);
  });
  const std::scoped_lock lock(mutex_);
  tree_.add(others);
}

RobotFrame::Pose RobotFrame::above(const std::string& sensor, Timestamp stamp) const {
  const std::scoped_lock lock(mutex_);
  const std::string root = tree_.root_of(sensor);
  return {root, tree_.lookup(sensor, root, stamp).value_or(Eigen::Isometry3d::Identity())};
}

}  // namespace mms
