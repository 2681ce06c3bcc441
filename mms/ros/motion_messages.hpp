#pragma once

#include "mms/core/motion_samples.hpp"
#include "mms/ros/ros_messages.hpp"

namespace mms {

WheelSample sample_of(const msg::Odometry& message);
ImuSample sample_of(const msg::Imu& message);

}  // namespace mms
