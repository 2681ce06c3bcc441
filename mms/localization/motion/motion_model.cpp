#include "mms/localization/motion/motion_model.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

/// [s]: time after which half of the velocity is left while no pose is measured.
/// Source: one frame of the simulated scenes, 15 Hz, where it was 0.5 per frame before. When people
/// cover the lens, the prediction moves on by the motion of 0.1 s, 0.13 s at 15 Hz.
constexpr double kVelocityHalfLife = 1.0 / 15.0;

/// [m, rad]: standard deviation of a measured pose.
/// Source: the error from frame to frame on `fr1_xyz_clip`, 5 mm and 6 mrad, is that of two poses
/// and of the reference.
constexpr double kMeasurementSigma = 0.003;

/// [m]: bound on the error between two measured poses.
/// Source: three sigma of kMeasurementSigma, rounded up.
constexpr double kMaxMeasurementError = 0.01;

/// [s]: bound on the error of the time between two frames.
/// Source: initial choice; stamps that a driver takes on arrival, each off by 10 ms.
constexpr double kMaxStampError = 0.02;

/// [-]: the same as a share of the shorter interval between frames.
/// Source: initial choice; at 30 Hz people pull a pose by less than the error that 20 ms would
/// allow.
constexpr double kMaxStampShare = 0.2;

/// [-]: ratio up to which two intervals count as equal. Source: initial choice; stamps are rounded.
constexpr double kMaxJitter = 1.2;

/// [s]: shortest interval for the bounds on speed.
/// Source: below the interval of any depth camera or LiDAR.
constexpr double kMinInterval = 1e-3;

/// [s]: time between the poses from which the sensors are followed to a new one.
/// Source: three frames of a camera of 15 Hz; each costs two more integrations.
constexpr double kAnchorInterval = 0.2;

/// [s]: time for which the sensors are followed to judge a pose.
/// Source: after it, the share of the way exceeds what people pull a pose by.
constexpr double kMaxAnchorAge = 3.0;

}  // namespace

void MotionConfig::visit(ConfigVisitor& v) {
  v.number({"acceleration", "m/s^2",
            "standard deviation; constrains the pose where data do not. 0: no prior"},
           acceleration, {0.0, 1000.0});
  v.number({"turn_acceleration", "rad/s^2", "standard deviation; 0: no prior"}, turn_acceleration,
           {0.0, 10000.0});
  v.number({"max_speed", "m/s", "a faster estimate is rejected"}, max_speed, {0.1, 1000.0});
  v.number({"max_turn_rate", "deg/s", "a faster estimate is rejected"}, max_turn_rate,
           {1.0, 36000.0});
  v.number({"max_acceleration", "m/s^2", "a faster change of the velocity is rejected"},
           max_acceleration, {0.1, 10000.0});
  v.group({"sensors", "", "wheels and gyroscope"}, sensors);
}

void MotionModel::place(Timestamp stamp, const Eigen::Isometry3d& pose) {
  stamp_ = measured_at_ = stamp;
  pose_ = measured_ = pose;
}

void MotionModel::move(Timestamp stamp, const Eigen::Isometry3d& pose) {
  place(stamp, pose);
  anchors_.clear();
  sensors_.compare(stamp, pose, false);
}

void MotionModel::rest(Timestamp stamp, const Eigen::Isometry3d& pose) {
  move(stamp, pose);
  velocity_.setZero();
  interval_.reset();
}

void MotionModel::measure(Timestamp stamp, const Eigen::Isometry3d& pose, bool is_reliable) {
  if (!sensors_.empty()) {
    sensors_.compare(stamp, pose, is_reliable);
    if (anchors_.empty() || to_seconds(stamp - anchors_.back().stamp) >= kAnchorInterval) {
      anchors_.push_back({stamp, pose});
    }
    while (to_seconds(stamp - anchors_.front().stamp) > kMaxAnchorAge) anchors_.pop_front();
  }
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
  const PosePrediction prediction = predict(stamp);
  const Eigen::Isometry3d last = pose_;
  pose_ = prediction.T_world_sensor;
  if (prediction.is_sensed) sensors_.compare(stamp, pose_, false);
  const double seconds = std::max(0.0, to_seconds(stamp - stamp_));  // stamps may go back
  velocity_ *= std::max(std::exp2(-seconds / kVelocityHalfLife), braked_share(seconds));
  if (seconds > kMinInterval && has_more_since_gap(stamp)) {
    velocity_ = velocity(stamp_, stamp);
    pose_ = last * se3::exp(velocity_ * seconds);
  }
  stamp_ = stamp;
}

/// Whether the sensors tell more about the motion since the last frame than about that since the
/// last measured pose, as after a gap in the measurements.
bool MotionModel::has_more_since_gap(Timestamp stamp) const {
  if (sensors_.empty()) return false;
  const auto last = sensors_.between(stamp_, stamp);
  const auto all = sensors_.between(measured_at_, stamp);
  return last && (!all || (last->has_translation && !all->has_translation));
}

/// Share of the speed that is left after braking at the limit: a vehicle does not stop immediately.
double MotionModel::braked_share(double seconds) const {
  const double speed = velocity_.head<3>().norm();
  return speed > 0.0 ? 1.0 - config_.max_acceleration * seconds / speed : 0.0;
}

/// The velocity between two frames has the error of their poses, divided by their interval. That of
/// the measurements is for equal intervals.
double MotionModel::error_growth(double seconds) const {
  return std::max(1.0, seconds / (kMaxJitter * *interval_));
}

/// The velocity is that at the center of its interval: after a time t with acceleration a, the
/// distance from the predicted pose is a/2 t (t + interval).
double MotionModel::deviation(double acceleration, double seconds) const {
  return 0.5 * acceleration * seconds * (seconds + *interval_);
}

/// A gyroscope alone does not know the way: that is extrapolated.
PosePrediction MotionModel::predict(Timestamp stamp) const {
  PosePrediction prediction = extrapolate(stamp);
  if (sensors_.empty()) return prediction;
  const auto sensed = sensors_.between(measured_at_, stamp);
  if (!sensed) return prediction;
  prediction.is_sensed = true;
  const Eigen::Isometry3d pose = measured_ * sensed->T_from_to;
  prediction.T_world_sensor.linear() = pose.linear();
  prediction.rotation_sigma = sensed->rotation_sigma;
  if (!sensed->has_translation) return prediction;
  prediction.T_world_sensor.translation() = pose.translation();
  prediction.translation_sigma = sensed->translation_sigma;
  return prediction;
}

std::optional<PosePrediction> MotionModel::contradiction(Timestamp stamp,
                                                         const Eigen::Isometry3d& pose) const {
  const auto check = [&](Timestamp from, const Eigen::Isometry3d& start) {
    std::optional<PosePrediction> prediction;
    const auto sensed = sensors_.between(from, stamp);
    if (!sensed || !sensed->contradicts(start.inverse() * pose)) return prediction;
    prediction = extrapolate(stamp);
    prediction->is_sensed = true;
    prediction->T_world_sensor.linear() = start.linear() * sensed->T_from_to.linear();
    prediction->rotation_sigma = sensed->rotation_sigma;
    if (sensed->has_translation) {
      prediction->T_world_sensor = start * sensed->T_from_to;
      prediction->translation_sigma = sensed->translation_sigma;
    }
    return prediction;
  };
  if (sensors_.empty()) return std::nullopt;
  if (auto found = check(measured_at_, measured_)) return found;
  for (const Anchor& anchor : anchors_) {
    if (auto found = check(anchor.stamp, anchor.pose)) return found;
  }
  return std::nullopt;
}

Vector6d MotionModel::velocity(Timestamp from, Timestamp to) const {
  const double seconds = to_seconds(to - from);
  if (sensors_.empty() || std::abs(seconds) < kMinInterval) return velocity_;
  const auto sensed = sensors_.between(from, to);
  if (!sensed) return velocity_;
  Vector6d velocity = se3::log(sensed->T_from_to) / seconds;
  if (!sensed->has_translation) velocity.head<3>() = velocity_.head<3>();
  return velocity;
}

Vector6d MotionModel::velocity_at(Timestamp stamp, const Eigen::Isometry3d& pose) const {
  const double seconds = since_measured(stamp);
  if (seconds < kMinInterval) return velocity_;
  const Vector6d mean = se3::log(measured_.inverse() * pose) / seconds;
  if (!interval_) return mean;
  // Both velocities are those at the centers of their intervals.
  return mean + (mean - velocity_) * (seconds / (seconds + *interval_));
}

PosePrediction MotionModel::extrapolate(Timestamp stamp) const {
  PosePrediction prediction;
  prediction.T_world_sensor = pose_ * se3::exp(velocity_ * to_seconds(stamp - stamp_));
  const double seconds = since_measured(stamp);
  if (!interval_ || seconds < 0.0) return prediction;
  const auto sigma = [&](double acceleration) {
    return acceleration > 0.0
               ? kMeasurementSigma * error_growth(seconds) + deviation(acceleration, seconds)
               : PosePrediction::kUnknown;
  };
  prediction.translation_sigma = sigma(config_.acceleration);
  prediction.rotation_sigma = sigma(config_.turn_acceleration);
  return prediction;
}

bool MotionModel::is_feasible(Timestamp stamp, const Eigen::Isometry3d& pose) const {
  const double seconds = std::max(since_measured(stamp), kMinInterval);
  if (interval_) {
    // A motion that no vehicle or person can make comes from people taken for static.
    const Eigen::Vector3d expected = extrapolate(stamp).T_world_sensor.translation();
    const double by_motion =
        kMaxMeasurementError * error_growth(seconds) + deviation(config_.max_acceleration, seconds);
    const double stamp_error =
        std::min(kMaxStampError, kMaxStampShare * std::min(seconds, *interval_));
    const double by_stamps =
        stamp_error * velocity_.head<3>().norm() * (1.0 + seconds / *interval_);
    if ((pose.translation() - expected).norm() > std::max(by_motion, by_stamps)) return false;
  }
  const Eigen::Isometry3d motion = measured_.inverse() * pose;
  return motion.translation().norm() <= config_.max_speed * seconds &&
         se3::angle(motion) <= config_.max_turn_rate * M_PI / 180.0 * seconds;
}

}  // namespace mms
