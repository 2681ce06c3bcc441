#pragma once

#include <mutex>
#include <string>

#include "mms/ros/transform_tree.hpp"

namespace mms {

/// The frame whose pose a node publishes on /tf. A frame has one parent only, and that of a sensor
/// is often the robot already. So it is the root of the sensor's tree: `base_link`, or the frame of
/// another odometry above it. Thread-safe.
class RobotFrame {
 public:
  struct Pose {
    std::string frame;
    Eigen::Isometry3d T_sensor_frame = Eigen::Isometry3d::Identity();
  };

  /// @param map, world  frames that the node publishes itself: transforms to and from them are
  ///                    ignored
  RobotFrame(std::string map, std::string world) : map_(std::move(map)), world_(std::move(world)) {}

  /// Adds a message of /tf or /tf_static.
  void add(const msg::Transforms& message);

  /// The root above a sensor and its pose at `stamp`; the sensor itself, if it has no parent.
  Pose above(const std::string& sensor, Timestamp stamp) const;

 private:
  /// Transforms kept of each moving frame: 10 s at 100 Hz, while frames wait for masks.
  static constexpr std::size_t kKept = 1000;

  std::string map_;
  std::string world_;
  mutable std::mutex mutex_;  ///< guards the following
  TransformTree tree_{kKept};
};

}  // namespace mms
