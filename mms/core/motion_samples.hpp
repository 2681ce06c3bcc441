#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"

namespace mms {

/// Pose of the wheels' frame by dead reckoning, as of nav_msgs/Odometry.
struct WheelSample {
  Timestamp stamp;                        ///< on the clock of the frames
  Transform<Odometer, Base> T_odom_base;  ///< drifts; only differences have a meaning
};

/// Measurement of a gyroscope with or without accelerometer, in its own frame.
struct ImuSample {
  Timestamp stamp;                                         ///< on the clock of the frames
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();          ///< angular rate [rad/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< specific force [m/s^2]
};

/// What sensors of motion beside the camera or LiDAR measured, each in order of stamps.
struct MotionSamples {
  std::vector<WheelSample> wheels;  ///< empty without wheels
  std::vector<ImuSample> imu;       ///< empty without a gyroscope

  /// Whether there is no measurement.
  bool empty() const { return wheels.empty() && imu.empty(); }
};

}  // namespace mms
