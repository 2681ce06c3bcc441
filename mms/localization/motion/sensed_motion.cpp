#include "mms/localization/motion/sensed_motion.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <chrono>
#include <cmath>

namespace mms {
namespace {

/// [rad]: one degree. Source: its definition.
constexpr double kDegree = M_PI / 180.0;

/// [-]: standard deviations from which on a motion contradicts a measured one.
/// Source: 1 % of a normal distribution in three dimensions is beyond.
constexpr double kMaxSigmas = 3.4;

/// [m]: standard deviation of the motion between two estimated poses.
/// Source: kMeasurementSigma of the motion model, for both.
constexpr double kPoseSigma = 0.0042;

/// [rad]: the same of the turn. Source: 0.15 degrees, the median of RPE on `fr1_xyz_clip` is 0.3.
constexpr double kTurnSigma = 0.0026;

/// [s]: length of the periods over which sensors are compared, and the bias is estimated.
/// Source: at 1 m/s the share of the way (2 cm) then exceeds the floor by far.
constexpr double kPeriod = 0.7;

/// [frames]: comparisons with single frames that are remembered. Source: about a second of a
/// camera.
constexpr std::size_t kFrames = 20;

/// [frames]: contradicting ones of them from which on a sensor is left out.
/// Source: slip or a blow that lasts for a fifth of a second is handled frame by frame.
constexpr long kMaxFrames = 8;

/// [-]: comparisons over periods that are remembered. Source: 4 s.
constexpr std::size_t kPeriods = 6;

/// [-]: contradicting ones of them from which on a sensor is left out. Source: half of them.
constexpr long kMaxPeriods = 3;

/// [s]: step of the derivative after the delay. Source: half of the smallest delay that matters.
constexpr std::chrono::milliseconds kShiftStep{10};

/// [s]: delays below it are not corrected. Source: at 1 rad/s^2 they change a turn by 0.02 degrees
/// a frame of 15 Hz, less than the floor.
constexpr double kMinShift = 0.006;

/// [s]: largest delay that is corrected. Source: longer ones exceed a linear estimate.
constexpr double kMaxShift = 0.1;

/// [-]: standard deviations by which a delay must differ from zero. Source: tried at every frame.
constexpr double kMinShiftSigmas = 4.0;

/// [-]: least noise of the poses over kPoseSigma and kTurnSigma. Source: that of good views.
constexpr double kMinNoise = 0.3;

/// [-]: comparisons before a delay is estimated. Source: two seconds of a camera.
constexpr int kMinResiduals = 40;

/// [rad]: turn of a sensor's axes from which on its mounting is suspected.
/// Source: the sideways error of wheels, 2 % of the way, is 1.1 degrees: more than twice that.
constexpr double kMinMounting = 2.5 * kDegree;

/// [-]: share of the squared differences that may remain under a suspected fault.
/// Source: then the fault explains half of them.
constexpr double kMaxRemaining = 0.5;

template <class Value>
void keep_last(std::deque<Value>& values, const Value& value, std::size_t count) {
  values.push_back(value);
  if (values.size() > count) values.pop_front();
}

long count(const std::deque<bool>& values) {
  return std::count(values.begin(), values.end(), true);
}

/// Axes of a base (x forward, y left, z up) in a camera that faces ahead (x right, y down).
Eigen::Isometry3d looking_ahead() {
  Eigen::Isometry3d T_camera_base = Eigen::Isometry3d::Identity();
  T_camera_base.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return T_camera_base;
}

/// The rotation from `from` to `to` of least squares (Kabsch).
Eigen::Matrix3d rotation_between(const std::vector<Eigen::Vector3d>& from,
                                 const std::vector<Eigen::Vector3d>& to) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) sum += to[i] * from[i].transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1.0, 1.0, 1.0);
  signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

std::string degrees_text(double radians) {
  return std::to_string(std::lround(radians / kDegree)) + " degrees";
}

std::string milliseconds_text(Duration duration) {
  return std::to_string(std::lround(1e3 * std::abs(to_seconds(duration)))) + " ms";
}

}  // namespace

void MotionSensorsConfig::visit(ConfigVisitor& v) {
  v.boolean({"wheels", "", "use the wheels where a recording has them"}, wheels);
  v.boolean({"imu", "", "use the gyroscope where a recording has one"}, imu);
  v.number({"wheel_floor", "m", "least standard deviation of a distance by the wheels"},
           wheel_floor, {1e-5, 1.0});
  v.number({"wheel_share", "", "standard deviation of a distance, as a share of it"}, wheel_share,
           {0.0, 1.0});
  v.number({"wheel_turn_floor", "deg", "least standard deviation of a turn by the wheels"},
           wheel_turn_floor, {1e-4, 45.0});
  v.number({"wheel_turn_share", "", "standard deviation of a turn, as a share of it"},
           wheel_turn_share, {0.0, 1.0});
  v.number({"gyro_floor", "deg", "least standard deviation of a turn by the gyroscope"}, gyro_floor,
           {1e-4, 45.0});
  v.number({"gyro_share", "", "standard deviation of a turn, as a share of it"}, gyro_share,
           {0.0, 1.0});
}

bool SensedMotion::contradicts(const Eigen::Isometry3d& other) const {
  const Vector6d difference = se3::log(T_from_to.inverse() * other);
  const bool far = has_translation && difference.head<3>().norm() >
                                          kMaxSigmas * std::hypot(translation_sigma, kPoseSigma);
  return far || difference.tail<3>().norm() > kMaxSigmas * std::hypot(rotation_sigma, kTurnSigma);
}

void MotionSensors::add(const MotionSamples& samples, const MotionCalibration& calibration,
                        bool is_camera) {
  const auto assume = [&](Kind kind, const char* key, const char* name) {
    if (std::exchange(assumed_[kind], true)) return;
    warnings_.push_back(std::string(name) + ": their mounting is not known; they are taken to be " +
                        "where the sensor is, which faces ahead (give " + key +
                        " in calibration.yaml)");
  };
  const Eigen::Isometry3d ahead = is_camera ? looking_ahead() : Eigen::Isometry3d::Identity();
  if (config_.wheels && !samples.wheels.empty()) {
    if (!calibration.T_sensor_base) assume(kWheels, "T_sensor_base", "wheels");
    T_sensor_base_ = calibration.T_sensor_base ? calibration.T_sensor_base->isometry() : ahead;
    wheels_.add(samples.wheels, calibration.wheel_delay);
  }
  if (config_.imu && !samples.imu.empty()) {
    if (!calibration.T_sensor_imu) assume(kGyroscope, "T_sensor_imu", "axes of the gyroscope");
    T_sensor_imu_ = calibration.T_sensor_imu ? calibration.T_sensor_imu->isometry() : ahead;
    gyroscope_.add(samples.imu, calibration.imu_delay);
  }
}

std::optional<SensedMotion> MotionSensors::by_wheels(Timestamp from, Timestamp to,
                                                     Duration shift) const {
  const auto motion = wheels_.between(from, to, shift);
  if (!motion) return std::nullopt;
  SensedMotion sensed;
  sensed.T_from_to = T_sensor_base_ * motion->T_from_to * T_sensor_base_.inverse();
  sensed.has_translation = true;
  sensed.rotation_sigma =
      std::hypot(config_.wheel_turn_floor * kDegree, config_.wheel_turn_share * motion->turn);
  sensed.translation_sigma = std::hypot(config_.wheel_floor, config_.wheel_share * motion->way);
  return sensed;
}

std::optional<SensedMotion> MotionSensors::by_gyroscope(Timestamp from, Timestamp to,
                                                        Duration shift) const {
  const auto turn = gyroscope_.between(from, to, shift);
  if (!turn) return std::nullopt;
  SensedMotion sensed;
  const Eigen::Matrix3d R_sensor_imu = T_sensor_imu_.linear();
  sensed.T_from_to.linear() = R_sensor_imu * turn->R_from_to * R_sensor_imu.transpose();
  const double drift = gyroscope_.bias_sigma() * std::abs(to_seconds(to - from));
  sensed.rotation_sigma =
      std::hypot(config_.gyro_floor * kDegree, config_.gyro_share * turn->angle, drift);
  return sensed;
}

std::optional<SensedMotion> MotionSensors::by(Kind kind, Timestamp from, Timestamp to,
                                              Duration shift) const {
  return kind == kWheels ? by_wheels(from, to, shift) : by_gyroscope(from, to, shift);
}

/// The gyroscope turns better than the wheels. Where both differ, the heading along the way was
/// wrong by half of that in the mean.
std::optional<SensedMotion> MotionSensors::between(Timestamp from, Timestamp to) const {
  const auto sensed = [&](Kind kind) {
    return agreement_[kind].left_out ? std::nullopt : by(kind, from, to, agreement_[kind].shift);
  };
  std::optional<SensedMotion> wheels = sensed(kWheels);
  std::optional<SensedMotion> turn = sensed(kGyroscope);
  if (!wheels || !turn) return wheels ? wheels : turn;
  if (turn->rotation_sigma >= wheels->rotation_sigma) return wheels;
  Eigen::Isometry3d difference = Eigen::Isometry3d::Identity();
  difference.linear() = turn->T_from_to.linear() * wheels->T_from_to.linear().transpose();
  turn->T_from_to.translation() =
      se3::interpolate(difference, 0.5).linear() * wheels->T_from_to.translation();
  turn->has_translation = true;
  turn->translation_sigma = wheels->translation_sigma;
  return turn;
}

void MotionSensors::compare(Timestamp stamp, const Eigen::Isometry3d& T_world_sensor,
                            bool is_reliable) {
  for (const Kind kind : {kWheels, kGyroscope}) {
    Agreement& agreement = agreement_[kind];
    if (is_reliable) {
      compare(kind, {stamp, T_world_sensor});
    } else {
      agreement.frame.reset();
      agreement.period.reset();
    }
  }
}

void MotionSensors::compare(Kind kind, const Pose& pose) {
  Agreement& agreement = agreement_[kind];
  if (agreement.frame) {
    const auto sensed = by(kind, agreement.frame->stamp, pose.stamp, agreement.shift);
    if (sensed) {
      const Eigen::Isometry3d estimated =
          agreement.frame->T_world_sensor.inverse() * pose.T_world_sensor;
      const bool contradicts = sensed->contradicts(estimated);
      keep_last(agreement.frames, contradicts, kFrames);
      keep_last(agreement.motions, {se3::log(estimated), se3::log(sensed->T_from_to)}, kFrames);
      if (!contradicts) compare_shifted(kind, pose);
    }
  }
  agreement.frame = pose;
  if (!agreement.period) agreement.period = pose;
  if (to_seconds(pose.stamp - agreement.period->stamp) >= kPeriod) compare_period(kind, pose);
  judge(kind, pose.stamp);
}

void MotionSensors::compare_period(Kind kind, const Pose& pose) {
  Agreement& agreement = agreement_[kind];
  const Pose start = *std::exchange(agreement.period, pose);
  const auto sensed = by(kind, start.stamp, pose.stamp, agreement.shift);
  if (!sensed) return;
  const Eigen::Isometry3d estimated = start.T_world_sensor.inverse() * pose.T_world_sensor;
  keep_last(agreement.periods, sensed->contradicts(estimated), kPeriods);
  if (kind != kGyroscope) return;
  const Eigen::Matrix3d R_sensor_imu = T_sensor_imu_.linear();
  gyroscope_.correct_bias(start.stamp, pose.stamp,
                          R_sensor_imu.transpose() * estimated.linear() * R_sensor_imu, kTurnSigma,
                          agreement.shift);
}

/// Least squares for a delay, from the derivative of the measured motion after it.
void MotionSensors::compare_shifted(Kind kind, const Pose& pose) {
  Agreement& agreement = agreement_[kind];
  const Pose& before = *agreement.frame;
  const auto motion = [&](Duration more) {
    return by(kind, before.stamp, pose.stamp, agreement.shift + more);
  };
  const auto now = motion(Duration(0));
  const auto later = motion(kShiftStep);
  const auto earlier = motion(-kShiftStep);
  if (!now || !later || !earlier) return;
  const Eigen::Isometry3d estimated = before.T_world_sensor.inverse() * pose.T_world_sensor;
  const double translation_weight = now->has_translation ? 1.0 / kPoseSigma : 0.0;
  const auto weighted = [&](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    Vector6d difference = se3::log(a.inverse() * b);
    difference.head<3>() *= translation_weight;
    difference.tail<3>() /= kTurnSigma;
    return difference;
  };
  const Vector6d slope =
      weighted(earlier->T_from_to, later->T_from_to) / (2.0 * to_seconds(kShiftStep));
  const Vector6d residual = weighted(now->T_from_to, estimated);
  agreement.shift_moment += slope.dot(residual);
  agreement.shift_square += slope.squaredNorm();
  agreement.residual_square += residual.squaredNorm();
  if (++agreement.residuals < kMinResiduals || agreement.shift_square <= 0.0) return;
  const double shift = agreement.shift_moment / agreement.shift_square;
  const double noise =
      std::max(kMinNoise, std::sqrt(agreement.residual_square / (3.0 * agreement.residuals)));
  const double sigma = noise / std::sqrt(agreement.shift_square);
  const double total = shift + to_seconds(agreement.shift);
  if (std::abs(shift) < std::max(kMinShift, kMinShiftSigmas * sigma)) return;
  if (std::abs(total) > kMaxShift) return;
  agreement.shift = Timestamp::from_seconds(total) - Timestamp();
  agreement.shift_moment = agreement.shift_square = agreement.residual_square = 0.0;
  agreement.residuals = 0;
  if (kind == kGyroscope) gyroscope_.forget_bias();
  warnings_.push_back(std::string(kind == kWheels ? "wheels" : "gyroscope") + ": stamps are " +
                      milliseconds_text(agreement.shift) +
                      (total > 0.0 ? " too late" : " too early") + " and were corrected (" +
                      (kind == kWheels ? "wheel_delay" : "imu_delay") + " in calibration.yaml)");
}

void MotionSensors::judge(Kind kind, Timestamp stamp) {
  Agreement& agreement = agreement_[kind];
  const long frames = count(agreement.frames);
  const long periods = count(agreement.periods);
  const char* name = kind == kWheels ? "wheels" : "gyroscope";
  if (!agreement.left_out && (frames >= kMaxFrames || periods >= kMaxPeriods)) {
    agreement.left_out = true;
    warnings_.push_back(std::string(name) + ": left out from " + stamp.to_string() +
                        " s on: " + fault_of(kind));
  } else if (agreement.left_out && frames == 0 && periods == 0 &&
             agreement.periods.size() == kPeriods) {
    agreement.left_out = false;
    warnings_.push_back(std::string(name) + ": used again from " + stamp.to_string() + " s on");
  }
}

/// What explains that a sensor contradicts the estimated poses.
std::string MotionSensors::fault_of(Kind kind) const {
  const bool is_wheels = kind == kWheels;
  std::vector<Eigen::Vector3d> estimated;
  std::vector<Eigen::Vector3d> measured;
  double estimated_way = 0.0;
  double measured_way = 0.0;
  double difference = 0.0;
  const Agreement& agreement = agreement_[kind];
  const bool only_contradicting = count(agreement.frames) >= kMaxFrames;
  for (std::size_t i = 0; i < agreement.motions.size(); ++i) {
    if (only_contradicting && !agreement.frames[i]) continue;
    const Pair& pair = agreement.motions[i];
    estimated.emplace_back(is_wheels ? pair.estimated.head<3>() : pair.estimated.tail<3>());
    measured.emplace_back(is_wheels ? pair.measured.head<3>() : pair.measured.tail<3>());
    estimated_way += estimated.back().norm();
    measured_way += measured.back().norm();
    difference += (estimated.back() - measured.back()).squaredNorm();
  }
  const std::string unknown = is_wheels ? "they contradict the frames: noise or slip?"
                                        : "it contradicts the frames: noise or a wrong mounting?";
  if (estimated.empty()) return unknown;
  constexpr double kStuckShare = 0.05;
  if (measured_way < kStuckShare * estimated_way) return "they do not change: stuck?";
  const double ratio = measured_way / estimated_way;
  constexpr double kDegreesPerRadian = 180.0 / M_PI;
  if (!is_wheels && ratio > 0.5 * kDegreesPerRadian && ratio < 2.0 * kDegreesPerRadian) {
    return "its rates are in degrees per second; they must be in rad/s";
  }
  const Eigen::Matrix3d mounting = rotation_between(measured, estimated);
  double remaining = 0.0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    remaining += (estimated[i] - mounting * measured[i]).squaredNorm();
  }
  const double angle = Eigen::AngleAxisd(mounting).angle();
  if (angle > kMinMounting && remaining < kMaxRemaining * difference) {
    return "turned by about " + degrees_text(angle) + " against the calibration: is " +
           (is_wheels ? "T_sensor_base" : "T_sensor_imu") + " right?";
  }
  constexpr double kSlipRatio = 1.1;
  if (is_wheels && ratio > kSlipRatio) return "they turn faster than the sensor moves: slip?";
  return unknown;
}

}  // namespace mms
