#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "mms/simulation/building/building.hpp"
#include "mms/simulation/config/scene_config.hpp"
#include "mms/simulation/world/motion.hpp"

namespace mms {

/// Trajectory of the camera: on a robot that follows the lane, facing forward, with a slow pan and
/// slight vibration.
class CameraMotion {
 public:
  /// @param seconds  duration of the trajectory
  CameraMotion(const SceneConfig& config, const Building& building, double seconds);

  /// Pose of the optical frame (x right, y down, z forward) in the building's frame.
  Eigen::Isometry3d T_building_camera(double seconds) const;

  /// Pose of the robot's base on the floor, which turns with the camera and does not shake.
  Eigen::Isometry3d T_building_base(double seconds) const;

  /// Mounting of the optical frame on the base, without the shaking.
  Eigen::Isometry3d T_base_camera() const;

  /// The robot that carries the camera.
  const Motion& robot() const { return robot_; }

  /// Its motion if it were not carried.
  const Motion& way() const { return way_; }

 private:
  double swing(double seconds) const;

  Motion way_;
  Motion robot_;
  double height_;
  bool still_;
  double swing_amplitude_;  ///< [rad]
  double swing_rate_;       ///< [rad/s]
  std::uint64_t seed_;
};

}  // namespace mms
