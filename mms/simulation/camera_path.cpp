#include "mms/simulation/camera_path.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

/// Optical frame that looks along `yaw` (from the room's x axis, to the left) and `pitch` (up).
Eigen::Matrix3d looking(double yaw, double pitch) {
  Eigen::Matrix3d R;
  R.col(0) = Eigen::Vector3d(std::sin(yaw), -std::cos(yaw), 0.0);
  R.col(2) = Eigen::Vector3d(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch),
                             std::sin(pitch));
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

}  // namespace

Eigen::Isometry3d camera_path(double seconds) {
  constexpr double kRate = 0.6;     // [rad/s], 0.3 m/s at the mean radius
  constexpr double kStartUp = 1.0;  // [s]
  const double driven =
      seconds < kStartUp ? 0.5 * seconds * seconds / kStartUp : seconds - 0.5 * kStartUp;
  const double angle = kRate * driven;
  Eigen::Isometry3d T_room_camera = Eigen::Isometry3d::Identity();
  T_room_camera.translation() << -1.6 - 0.5 * std::cos(angle), 0.5 * std::sin(angle),
      1.25 + 0.06 * std::sin(2.0 * angle);
  T_room_camera.linear() = looking(0.6 * std::sin(angle), -0.10 + 0.06 * std::sin(2.0 * angle));
  return T_room_camera;
}

}  // namespace mms
