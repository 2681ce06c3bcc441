#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "mms/core/config.hpp"
#include "mms/core/time.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/localization/motion/pose_prediction.hpp"

namespace mms {

struct MotionConfig {
  double acceleration = 1.0;
  double turn_acceleration = 5.0;
  double max_speed = 30.0;
  double max_turn_rate = 720.0;
  double max_acceleration = 10.0;

  void visit(ConfigVisitor& v);
};

/// Where the sensor is expected: it goes on as it went between the last two poses measured, and
/// changes its velocity as `MotionConfig` says that it may.
class MotionModel {
 public:
  explicit MotionModel(const MotionConfig& config) : config_(config) {}

  /// The pose at `stamp` is known, and nothing new of the velocity.
  void place(Timestamp stamp, const Eigen::Isometry3d& pose);

  /// A pose was measured.
  void measure(Timestamp stamp, const Eigen::Isometry3d& pose);

  /// None was: the sensor goes on with fading velocity.
  void coast(Timestamp stamp);

  /// The uncertainty grows with the time since a pose was measured; without bound while the
  /// velocity is unknown.
  PosePrediction predict(Timestamp stamp) const;

  /// Whether the sensor can have come there.
  bool is_feasible(Timestamp stamp, const Eigen::Isometry3d& pose) const;

  /// Between the last two poses measured, in the sensor's frame [m/s, rad/s]; zero before.
  const Vector6d& velocity() const { return velocity_; }

  const Eigen::Isometry3d& pose() const { return pose_; }
  Timestamp stamp() const { return stamp_; }  ///< that `pose` is of

 private:
  double since_measured(Timestamp stamp) const { return to_seconds(stamp - measured_at_); }
  double deviation(double acceleration, double seconds) const;

  MotionConfig config_;
  Timestamp stamp_;
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
  Timestamp measured_at_;
  Eigen::Isometry3d measured_ = Eigen::Isometry3d::Identity();
  Vector6d velocity_ = Vector6d::Zero();
  std::optional<double> interval_;  ///< over which the velocity was measured [s]
};

}  // namespace mms
