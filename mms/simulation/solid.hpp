#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "mms/simulation/material.hpp"

namespace mms {

enum class Shape : std::uint8_t { kBox, kEllipsoid };

/// A box or ellipsoid in the room frame (z up, origin in the middle of the floor).
struct Solid {
  Shape shape = Shape::kBox;
  Eigen::Isometry3f T_room_solid = Eigen::Isometry3f::Identity();
  Eigen::Vector3f half = Eigen::Vector3f::Ones();  ///< half its extent along its axes [m]
  Material material;
  std::uint8_t label = 0;  ///< value in the mask image: 0 static, else 1 + class id

  /// A box or ellipsoid parallel to the room.
  static Solid at(Shape shape, const Eigen::Vector3f& center, const Eigen::Vector3f& half,
                  const Material& material) {
    Solid solid{shape, Eigen::Isometry3f::Identity(), half, material};
    solid.T_room_solid.translation() = center;
    return solid;
  }
};

}  // namespace mms
