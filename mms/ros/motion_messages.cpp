#include "mms/ros/motion_messages.hpp"

#include "mms/ros/transform_tree.hpp"

namespace mms {

WheelSample sample_of(const msg::Odometry& message) {
  return {message.header.stamp, Transform<Odometer, Base>(isometry_of(message.pose))};
}

ImuSample sample_of(const msg::Imu& message) {
  return {message.header.stamp, Eigen::Map<const Eigen::Vector3d>(message.angular_velocity.data()),
          Eigen::Map<const Eigen::Vector3d>(message.linear_acceleration.data())};
}

}  // namespace mms
