#include "mms/simulation/world/camera_trajectory.hpp"

#include <cmath>
#include <numbers>

#include "mms/core/hash_noise.hpp"
#include "mms/simulation/world/carrying.hpp"
#include "mms/simulation/world/route.hpp"

namespace mms {
namespace {

constexpr double kPitch = 0.06;         // downward pitch [rad]
constexpr double kShakeAngle = 0.003;   // [rad]
constexpr double kShakeHeight = 0.002;  // [m]

/// Position of a static camera from the end of the lane: far enough for people to cross in front of
/// it, near enough to see the wall.
constexpr double kStillFromEnd = 8.0;  // [m]

Motion still_robot(const Building& building) {
  const Eigen::Vector2d end = building.lane[1];
  const Eigen::Vector2d ahead = (end - building.lane[0]).normalized();
  return Motion::still(end - kStillFromEnd * ahead, std::atan2(ahead.y(), ahead.x()));
}

Motion way_of(const SceneConfig& config, const Building& building, double seconds) {
  if (config.trajectory == CameraTrajectory::kStill) return still_robot(building);
  Route route;
  route.corners = building.lane;
  route.end = building.lane_closed ? RouteEnd::kLoop : RouteEnd::kStop;
  route.speed = config.speed;
  route.acceleration = 0.5;
  route.look_ahead = 0.9;
  if (config.trajectory == CameraTrajectory::kAlong && building.lane_closed) route.start = 2.0;
  constexpr double kDailyStart = 2.0;  // [m]
  if (config.trajectory == CameraTrajectory::kLoop) route.start = kDailyStart * config.day;
  route.start += config.start;
  // Companions are some seconds ahead.
  return drive(route, config.companions > 0 ? seconds + 5.0 : seconds);
}

/// Smooth noise of about unit size with a frequency of a few Hz.
double shake(std::uint64_t seed, double seconds) {
  double sum = 0.0;
  for (std::uint64_t i = 0; i < 4; ++i) {
    const auto phase = static_cast<double>(uniform_of(hash_of(seed, i)));
    const auto detune = static_cast<double>(uniform_of(hash_of(seed, i + 7)));
    const double hz = 0.7 + 1.3 * (static_cast<double>(i) + detune);
    sum += std::sin(6.2831853 * (hz * seconds + phase)) / (1.0 + static_cast<double>(i));
  }
  return 0.6 * sum;
}

/// From the camera (x right, y down, z forward) to the robot (x forward, y left, z up).
Eigen::Matrix3d optical_axes() {
  Eigen::Matrix3d optical;
  optical << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return optical;
}

constexpr double kShakenSwing = 0.55;  // amplitude of the trajectory `shaken` [rad]

double swing_rate(const SceneConfig& config) {
  if (config.trajectory != CameraTrajectory::kShaken) return 0.5;
  return config.turn_rate > 0.0 ? config.turn_rate * std::numbers::pi / 180.0 / kShakenSwing : 2.4;
}

}  // namespace

CameraMotion::CameraMotion(const SceneConfig& config, const Building& building, double seconds)
    : way_(way_of(config, building, seconds)),
      robot_(config.carried ? carried(config, way_, seconds) : way_),
      height_(config.camera_height),
      still_(config.trajectory == CameraTrajectory::kStill),
      swing_amplitude_(config.trajectory == CameraTrajectory::kShaken ? kShakenSwing : 0.12),
      swing_rate_(swing_rate(config)),
      seed_(daily_seed(config, 0xca3)) {}

double CameraMotion::swing(double seconds) const {
  return swing_amplitude_ * std::sin(swing_rate_ * seconds);
}

Eigen::Isometry3d CameraMotion::T_building_camera(double seconds) const {
  Eigen::Isometry3d T = robot_.T_world_object(seconds);
  T.translate(Eigen::Vector3d(0.0, 0.0, height_));
  double pitch = kPitch;
  double roll = 0.0;
  if (!still_) {
    T.rotate(Eigen::AngleAxisd(swing(seconds), Eigen::Vector3d::UnitZ()));
    T.translate(Eigen::Vector3d(0.0, 0.0, kShakeHeight * shake(seed_, seconds)));
    pitch += kShakeAngle * shake(seed_ + 1, seconds);
    roll = kShakeAngle * shake(seed_ + 2, seconds);
  }
  T.rotate(Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()));
  T.rotate(Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()));
  T.linear() = T.linear() * optical_axes();
  return T;
}

Eigen::Isometry3d CameraMotion::T_building_base(double seconds) const {
  Eigen::Isometry3d T = robot_.T_world_object(seconds);
  if (!still_) T.rotate(Eigen::AngleAxisd(swing(seconds), Eigen::Vector3d::UnitZ()));
  return T;
}

Eigen::Isometry3d CameraMotion::T_base_camera() const {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Eigen::Vector3d(0.0, 0.0, height_));
  T.rotate(Eigen::AngleAxisd(kPitch, Eigen::Vector3d::UnitY()));
  T.linear() = T.linear() * optical_axes();
  return T;
}

}  // namespace mms
