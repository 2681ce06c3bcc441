#pragma once

#include <Eigen/Geometry>

namespace mms {

/// Camera pose in the room after so many seconds: driven at about 0.3 m/s round an ellipse, nodding
/// and looking from side to side, from rest. Optical frame (x right, y down, z forward).
Eigen::Isometry3d camera_path(double seconds);

}  // namespace mms
