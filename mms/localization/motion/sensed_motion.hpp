#pragma once

#include <Eigen/Geometry>
#include <array>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/config_visitor.hpp"
#include "mms/core/motion_samples.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/localization/motion/gyroscope.hpp"
#include "mms/localization/motion/wheel_odometry.hpp"

namespace mms {

/// How far wheels and gyroscope are believed. The standard deviation of a motion is the root of the
/// sum of squares of floor and share.
struct MotionSensorsConfig {
  bool wheels = true;
  bool imu = true;
  double wheel_floor = 0.002;
  double wheel_share = 0.02;
  double wheel_turn_floor = 0.1;
  double wheel_turn_share = 0.03;
  double gyro_floor = 0.05;
  double gyro_share = 0.01;

  void visit(ConfigVisitor& v);
};

/// Motion of the sensor between two times as measured by wheels, gyroscope, or both.
struct SensedMotion {
  Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity();
  bool has_translation = false;    ///< false without wheels: it is zero
  double translation_sigma = 0.0;  ///< standard deviation along each axis [m]
  double rotation_sigma = 0.0;     ///< about each axis [rad]

  /// Whether another motion between these times is beyond the standard deviations.
  bool contradicts(const Eigen::Isometry3d& T_from_to) const;
};

/// The wheels and the gyroscope of a sensor: what they say on its motion, and how far they agree
/// with the estimated poses. Those that do not are left out, and delays of their stamps removed.
class MotionSensors {
 public:
  explicit MotionSensors(const MotionSensorsConfig& config) : config_(config) {}

  /// Measurements up to the end of the next frame. Without extrinsics, a sensor of motion is taken
  /// to be where the camera or LiDAR is, which faces ahead.
  /// @param is_camera  whether the sensor's frame is that of a camera
  void add(const MotionSamples& samples, const MotionCalibration& calibration, bool is_camera);

  /// Whether there are no measurements at all.
  bool empty() const { return wheels_.empty() && gyroscope_.empty(); }

  /// By the sensors that are not left out; nothing without measurements for the whole time.
  std::optional<SensedMotion> between(Timestamp from, Timestamp to) const;

  /// Compares the motion since the last call with an estimated pose.
  /// @param is_reliable  whether data determined the pose in all directions
  void compare(Timestamp stamp, const Eigen::Isometry3d& T_world_sensor, bool is_reliable);

  /// What was found since the last call, one line each.
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

 private:
  enum Kind : std::size_t { kWheels, kGyroscope };

  struct Pose {
    Timestamp stamp;
    Eigen::Isometry3d T_world_sensor;
  };

  /// The same motion, as estimated and as measured.
  struct Pair {
    Vector6d estimated;
    Vector6d measured;
  };

  /// Agreement of one sensor with the estimated poses.
  struct Agreement {
    std::deque<bool> frames;     ///< whether the last frames contradicted it
    std::deque<bool> periods;    ///< the same over the last periods
    std::deque<Pair> motions;    ///< over the last periods
    std::optional<Pose> frame;   ///< the last one
    std::optional<Pose> period;  ///< start of the current one
    bool left_out = false;
    Duration shift{0};          ///< added to times: the estimated delay of its stamps
    double shift_moment = 0.0;  ///< of the least squares for a further delay
    double shift_square = 0.0;
    double residual_square = 0.0;
    int residuals = 0;
  };

  std::optional<SensedMotion> by(Kind kind, Timestamp from, Timestamp to, Duration shift) const;
  std::optional<SensedMotion> by_wheels(Timestamp from, Timestamp to, Duration shift) const;
  std::optional<SensedMotion> by_gyroscope(Timestamp from, Timestamp to, Duration shift) const;
  void compare(Kind kind, const Pose& pose);
  void compare_period(Kind kind, const Pose& pose);
  void compare_shifted(Kind kind, const Pose& pose);
  void judge(Kind kind, Timestamp stamp);
  std::string fault_of(Kind kind) const;

  MotionSensorsConfig config_;
  WheelOdometry wheels_;
  Gyroscope gyroscope_;
  Eigen::Isometry3d T_sensor_base_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_sensor_imu_ = Eigen::Isometry3d::Identity();
  std::array<Agreement, 2> agreement_;
  std::array<bool, 2> assumed_{};  ///< extrinsics that are not known
  std::vector<std::string> warnings_;
};

}  // namespace mms
