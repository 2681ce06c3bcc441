#pragma once

#include <Eigen/Geometry>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/simulation/ray_caster.hpp"
#include "mms/simulation/solid.hpp"

namespace mms {

/// Unit normal, outwards, in the room frame, at a point of the solid's surface (room frame [m]).
Eigen::Vector3f surface_normal(const Solid& solid, const Eigen::Vector3f& point);

/// Colour image of the cast solids under the room's fixed lights, without noise. A surface looks
/// the same from everywhere, as photometric registration assumes of most of the world.
Image<Rgb> shade(const CastImage& cast, const std::vector<Solid>& solids,
                 const CameraIntrinsics& camera, const Eigen::Isometry3d& T_room_camera);

}  // namespace mms
