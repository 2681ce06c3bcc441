#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/config_visitor.hpp"
#include "mms/core/time.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/localization/motion/pose_prediction.hpp"
#include "mms/localization/motion/sensed_motion.hpp"

namespace mms {

struct MotionConfig {
  double acceleration = 1.0;
  double turn_acceleration = 5.0;
  double max_speed = 30.0;
  double max_turn_rate = 720.0;
  double max_acceleration = 10.0;
  MotionSensorsConfig sensors;

  void visit(ConfigVisitor& v);
};

/// Predicts the sensor's pose with the velocity between the last two measured poses, and with the
/// uncertainty that the accelerations of `MotionConfig` give; or by wheels and gyroscope.
class MotionModel {
 public:
  explicit MotionModel(const MotionConfig& config) : config_(config), sensors_(config.sensors) {}

  /// Adds measurements of wheels and gyroscope, see `MotionSensors`.
  void sense(const MotionSamples& samples, const MotionCalibration& calibration, bool is_camera) {
    sensors_.add(samples, calibration, is_camera);
  }

  /// Sets the pose at `stamp`; the velocity stays.
  void place(Timestamp stamp, const Eigen::Isometry3d& pose);

  /// The same where earlier poses were in another frame.
  void move(Timestamp stamp, const Eigen::Isometry3d& pose);

  /// Sets the pose of a sensor of unknown velocity.
  void rest(Timestamp stamp, const Eigen::Isometry3d& pose);

  /// Adds a measured pose: the velocity is that since the last one.
  /// @param is_reliable  whether data determined it in all directions
  void measure(Timestamp stamp, const Eigen::Isometry3d& pose, bool is_reliable = true);

  /// Without a measured pose: moves on by the sensors where they measured the motion, else with a
  /// decaying velocity.
  void coast(Timestamp stamp);

  /// By the sensors where they measured the motion, else by the velocity.
  PosePrediction predict(Timestamp stamp) const;

  /// By the velocity alone. The uncertainty grows with the time since a pose was measured; without
  /// bound while the velocity is unknown.
  PosePrediction extrapolate(Timestamp stamp) const;

  /// Where the sensors contradict a pose: the pose by them, from one of the last seconds.
  std::optional<PosePrediction> contradiction(Timestamp stamp, const Eigen::Isometry3d& pose) const;

  /// Whether speed, turn rate and acceleration up to `pose` are within the bounds.
  bool is_feasible(Timestamp stamp, const Eigen::Isometry3d& pose) const;

  /// Between the last two measured poses, in the sensor's frame [m/s, rad/s]; zero before.
  const Vector6d& velocity() const { return velocity_; }

  /// At `stamp`, if the sensor is at `pose` then: the velocity since the last measured pose and the
  /// one before, extrapolated.
  Vector6d velocity_at(Timestamp stamp, const Eigen::Isometry3d& pose) const;

  /// That between two times, by the sensors where they measured it.
  Vector6d velocity(Timestamp from, Timestamp to) const;

  /// What was found about the sensors since the last call, one line each.
  std::vector<std::string> take_warnings() { return sensors_.take_warnings(); }

  /// Whether two poses gave a velocity.
  bool knows_velocity() const { return interval_.has_value(); }
  const Eigen::Isometry3d& pose() const { return pose_; }
  const Eigen::Isometry3d& measured() const { return measured_; }  ///< the last measured pose
  Timestamp stamp() const { return stamp_; }                       ///< of `pose`

 private:
  double since_measured(Timestamp stamp) const { return to_seconds(stamp - measured_at_); }
  double deviation(double acceleration, double seconds) const;
  double braked_share(double seconds) const;
  double error_growth(double seconds) const;
  bool has_more_since_gap(Timestamp stamp) const;

  MotionConfig config_;
  Timestamp stamp_;
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
  Timestamp measured_at_;
  Eigen::Isometry3d measured_ = Eigen::Isometry3d::Identity();
  Vector6d velocity_ = Vector6d::Zero();
  std::optional<double> interval_;  ///< over which the velocity was measured [s]
  struct Anchor {
    Timestamp stamp;
    Eigen::Isometry3d pose;
  };
  MotionSensors sensors_;
  std::deque<Anchor> anchors_;  ///< measured poses of the last seconds; empty without sensors
};

}  // namespace mms
