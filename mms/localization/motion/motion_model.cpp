#include "mms/localization/motion/motion_model.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

/// Velocity kept from frame to frame while nothing is measured: people who stop before the lens do
/// not send the estimate through the wall.
constexpr double kCoasting = 0.5;

/// How far two measurements of one pose may be apart [m].
constexpr double kMeasurementError = 0.01;

/// Standard deviation of a measured pose [m, rad].
constexpr double kMeasurementSigma = 0.003;

}  // namespace

void MotionConfig::visit(ConfigVisitor& v) {
  v.number({"acceleration", "m/s^2",
            "standard deviation; holds the pose where a frame says little. 0: expect nothing"},
           acceleration, {0.0, 1000.0});
  v.number({"turn_acceleration", "rad/s^2", "standard deviation; 0: expect nothing"},
           turn_acceleration, {0.0, 10000.0});
  v.number({"max_speed", "m/s", "a faster estimate is not believed"}, max_speed, {0.1, 1000.0});
  v.number({"max_turn_rate", "deg/s", "a faster estimate is not believed"}, max_turn_rate,
           {1.0, 36000.0});
  v.number({"max_acceleration", "m/s^2", "a faster change of the velocity is not believed"},
           max_acceleration, {0.1, 10000.0});
}

void MotionModel::place(Timestamp stamp, const Eigen::Isometry3d& pose) {
  stamp_ = measured_at_ = stamp;
  pose_ = measured_ = pose;
}

void MotionModel::measure(Timestamp stamp, const Eigen::Isometry3d& pose) {
  const double seconds = since_measured(stamp);
  if (seconds > 0.0) {
    interval_ = seconds;
    velocity_ = se3::log(measured_.inverse() * pose) / seconds;
  } else {
    interval_.reset();
    velocity_.setZero();
  }
  place(stamp, pose);
}

void MotionModel::coast(Timestamp stamp) {
  pose_ = predict(stamp).T_world_sensor;
  stamp_ = stamp;
  velocity_ *= kCoasting;
}

/// The velocity is that of the middle of its interval: after a time t under an acceleration a the
/// sensor is a/2 t (t + interval) from where it would go with it.
double MotionModel::deviation(double acceleration, double seconds) const {
  return 0.5 * acceleration * seconds * (seconds + *interval_);
}

PosePrediction MotionModel::predict(Timestamp stamp) const {
  PosePrediction prediction;
  prediction.T_world_sensor = pose_ * se3::exp(velocity_ * to_seconds(stamp - stamp_));
  const double seconds = since_measured(stamp);
  if (!interval_ || seconds < 0.0) return prediction;
  const auto sigma = [&](double acceleration) {
    return acceleration > 0.0 ? kMeasurementSigma + deviation(acceleration, seconds)
                              : PosePrediction::kUnknown;
  };
  prediction.translation_sigma = sigma(config_.acceleration);
  prediction.rotation_sigma = sigma(config_.turn_acceleration);
  return prediction;
}

bool MotionModel::is_feasible(Timestamp stamp, const Eigen::Isometry3d& pose) const {
  const double seconds = std::max(since_measured(stamp), 1e-3);
  if (interval_) {
    // What nothing on wheels or legs can do is people who were taken for the world.
    const Eigen::Vector3d expected = predict(stamp).T_world_sensor.translation();
    const double limit = kMeasurementError + deviation(config_.max_acceleration, seconds);
    if ((pose.translation() - expected).norm() > limit) return false;
  }
  const Eigen::Isometry3d motion = measured_.inverse() * pose;
  return motion.translation().norm() <= config_.max_speed * seconds &&
         se3::angle(motion) <= config_.max_turn_rate * M_PI / 180.0 * seconds;
}

}  // namespace mms
