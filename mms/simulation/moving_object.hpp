#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "mms/core/segmentation.hpp"
#include "mms/simulation/solid.hpp"

namespace mms {

/// The way of one person or AGV: round and round a narrow ellipse on the floor, which looks like
/// walking to and fro with a turn at either end.
struct MovingObject {
  ObjectClass object_class = ObjectClass::kPerson;
  Eigen::Vector2d center{0.0, 0.0};  ///< of the ellipse, room frame [m]
  Eigen::Vector2d half{0.2, 1.5};    ///< half axes along the room's x and y [m]
  double rate = 0.6;                 ///< [rad/s]
  double phase = 0.0;                ///< [rad]
  std::uint32_t seed = 1;            ///< of clothes and textures

  Eigen::Vector2d position(double seconds) const;  ///< on the floor, room frame [m]
  Eigen::Vector2d velocity(double seconds) const;  ///< [m/s]

  /// Origin on the floor below the object, x forward, z up.
  Eigen::Isometry3d T_room_object(double seconds) const;

  /// Its body at that time: torso, head and swinging limbs, or the vehicle's parts.
  std::vector<Solid> solids(double seconds) const;

  /// Half the extent of the box around its body, and that box's centre is above the origin [m].
  Eigen::Vector3d half_extent() const;
};

/// `people` persons (at most 8) that cross the room at different distances, and one AGV.
std::vector<MovingObject> moving_objects(int people, std::uint32_t seed);

}  // namespace mms
