#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/simulation/solid.hpp"

namespace mms {

/// What a pinhole camera sees, exactly.
struct CastImage {
  Image<float> depth;         ///< z of the nearest surface [m]; infinite for none
  Image<std::int32_t> solid;  ///< index of the solid it belongs to, -1 for none
};

/// Casts the rays of all pixels at the solids. Rows are rendered in parallel; the camera must be
/// free of distortion.
CastImage cast_rays(const std::vector<Solid>& solids, const CameraIntrinsics& camera,
                    const Eigen::Isometry3d& T_room_camera);

}  // namespace mms
