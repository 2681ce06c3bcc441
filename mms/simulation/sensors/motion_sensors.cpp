#include "mms/simulation/sensors/motion_sensors.hpp"

#include <cmath>
#include <numbers>

#include "mms/core/hash_noise.hpp"
#include "mms/core/random_stream.hpp"
#include "mms/geometry/se3.hpp"

namespace mms {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kGravity = 9.81;         // [m/s^2]
constexpr double kDerivativeStep = 1e-3;  // [s], below the period of the trajectories' vibration

double normal(RandomStream& random) {
  return static_cast<double>(normal_of(random.bits()));
}

double sign(RandomStream& random) {
  return random.chance(0.5F) ? 1.0 : -1.0;
}

Eigen::Vector3d normal_vector(RandomStream& random) {
  const double x = normal(random);
  const double y = normal(random);
  return {x, y, normal(random)};
}

/// Time that a stuck sensor shows at a time.
double shown(const MotionFaults& faults, double seconds) {
  return faults.stuck_from > 0.0 ? std::min(seconds, faults.stuck_from) : seconds;
}

Timestamp stamp_of(const MotionFaults& faults, double seconds) {
  return Timestamp::from_seconds(seconds + faults.delay);
}

/// Angular rate in the frame of the pose [rad/s].
Eigen::Vector3d rate_at(const PoseAt& pose, double seconds) {
  const Eigen::Isometry3d motion =
      pose(seconds - kDerivativeStep).inverse() * pose(seconds + kDerivativeStep);
  return se3::log(motion).tail<3>() / (2.0 * kDerivativeStep);
}

Eigen::Vector3d acceleration_at(const PoseAt& pose, double seconds) {
  constexpr double h = 4.0 * kDerivativeStep;
  const Eigen::Isometry3d now = pose(seconds);
  const Eigen::Vector3d change =
      pose(seconds - h).translation() - 2.0 * now.translation() + pose(seconds + h).translation();
  const Eigen::Vector3d up(0.0, 0.0, kGravity);
  return now.linear().transpose() * (change / (h * h) + up);
}

}  // namespace

void MotionFaults::visit(ConfigVisitor& v) {
  v.number({"stuck_from", "s", "fault: nothing changes from then on; 0: never"}, stuck_from,
           {0.0, 1e5});
  v.number({"delay", "s", "fault: by which stamps are too late"}, delay, {-1.0, 1.0});
  v.number({"mounting_error", "deg", "fault: of the calibration of its mounting"}, mounting_error,
           {-180.0, 180.0});
}

void WheelConfig::visit(ConfigVisitor& v) {
  v.boolean({"enabled", "", "whether the wheels are measured"}, enabled);
  v.number({"rate", "1/s", "measurements per second"}, rate, {1.0, 1000.0});
  v.number({"scale_error", "", "of all distances"}, scale_error, {0.0, 0.5});
  v.number({"turn_error", "", "of all turns"}, turn_error, {0.0, 0.5});
  v.number({"noise", "m", "of the distance after one meter"}, noise, {0.0, 1.0});
  v.number({"turn_noise", "rad", "of the heading after one radian"}, turn_noise, {0.0, 1.0});
  v.number({"slip", "", "share by which slipping wheels exceed the distance"}, slip, {-1.0, 10.0});
  v.number({"slip_from", "s", "start of the slip"}, slip_from, {0.0, 1e5});
  v.number({"slip_for", "s", "duration of the slip"}, slip_for, {0.0, 1e5});
  v.number({"jitter", "m", "fault: independent error of every position"}, jitter, {0.0, 1.0});
  faults.visit(v);
}

void ImuConfig::visit(ConfigVisitor& v) {
  v.boolean({"enabled", "", "whether a gyroscope with accelerometer measures"}, enabled);
  v.number({"rate", "1/s", "measurements per second"}, rate, {1.0, 4000.0});
  v.number({"noise", "rad/s/Hz^0.5", "of the rates"}, noise, {0.0, 1.0});
  v.number({"bias", "rad/s", "of the rates"}, bias, {0.0, 1.0});
  v.number({"bias_walk", "rad/s", "change of the bias after one second"}, bias_walk, {0.0, 1.0});
  v.number({"scale_error", "", "of the rates"}, scale_error, {0.0, 0.5});
  v.number({"acceleration_noise", "m/s^2/Hz^0.5", "of the accelerations"}, acceleration_noise,
           {0.0, 10.0});
  v.number({"jitter", "rad/s", "fault: more noise of every rate"}, jitter, {0.0, 100.0});
  faults.visit(v);
}

std::vector<WheelSample> measure_wheels(const PoseAt& T_building_base, double seconds,
                                        const WheelConfig& config, std::uint64_t seed) {
  std::vector<WheelSample> samples;
  if (!config.enabled) return samples;
  RandomStream random(seed);
  const double scale = 1.0 + sign(random) * config.scale_error;
  const double turn_scale = 1.0 + sign(random) * config.turn_error;
  const Eigen::Rotation2Dd mounting(config.faults.mounting_error * kDegree);
  Eigen::Isometry3d before = T_building_base(0.0);
  Eigen::Isometry3d sum = Eigen::Isometry3d::Identity();
  const auto count = static_cast<int>(seconds * config.rate);
  for (int i = 0; i <= count; ++i) {
    const double at = i / config.rate;
    const Eigen::Isometry3d now = T_building_base(shown(config.faults, at));
    const Vector6d way = se3::log(before.inverse() * now);
    before = now;
    const bool slips = at > config.slip_from && at <= config.slip_from + config.slip_for;
    Eigen::Vector2d step = mounting * way.head<2>() * scale * (slips ? 1.0 + config.slip : 1.0);
    const double along = config.noise * std::sqrt(step.norm());
    step.x() += along * normal(random);
    step.y() += along * normal(random);
    const double turn =
        turn_scale * way(5) + config.turn_noise * std::sqrt(std::abs(way(5))) * normal(random);
    Vector6d measured = Vector6d::Zero();
    measured(0) = step.x();
    measured(1) = step.y();
    measured(5) = turn;
    sum = se3::normalized(sum * se3::exp(measured));
    Eigen::Isometry3d pose = sum;
    pose.translation().x() += config.jitter * normal(random);
    pose.translation().y() += config.jitter * normal(random);
    const Timestamp stamp = stamp_of(config.faults, at);
    if (stamp >= Timestamp()) samples.push_back({stamp, Transform<Odometer, Base>(pose)});
  }
  return samples;
}

std::vector<ImuSample> measure_imu(const PoseAt& T_building_imu, double seconds,
                                   const ImuConfig& config, std::uint64_t seed) {
  std::vector<ImuSample> samples;
  if (!config.enabled) return samples;
  RandomStream random(seed);
  const double scale = 1.0 + sign(random) * config.scale_error;
  const double root_rate = std::sqrt(config.rate);
  Eigen::Vector3d bias = config.bias * normal_vector(random).normalized();
  const Eigen::Matrix3d mounting =
      Eigen::AngleAxisd(config.faults.mounting_error * kDegree, normal_vector(random).normalized())
          .toRotationMatrix();
  const auto count = static_cast<int>(seconds * config.rate);
  for (int i = 0; i <= count; ++i) {
    const double at = i / config.rate;
    const double measured_at = shown(config.faults, at);
    ImuSample sample;
    sample.stamp = stamp_of(config.faults, at);
    sample.rate = mounting * (scale * rate_at(T_building_imu, measured_at)) + bias;
    sample.acceleration = mounting * acceleration_at(T_building_imu, measured_at);
    if (measured_at == at) {  // a stuck sensor has no noise
      sample.rate += std::hypot(config.noise * root_rate, config.jitter) * normal_vector(random);
      sample.acceleration += config.acceleration_noise * root_rate * normal_vector(random);
      bias += config.bias_walk / root_rate * normal_vector(random);
    }
    if (sample.stamp >= Timestamp()) samples.push_back(sample);
  }
  return samples;
}

}  // namespace mms
