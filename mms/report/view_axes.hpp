#pragma once

#include <Eigen/Core>

namespace mms {

/// Where up is in a world frame.
enum class UpAxis {
  kNegativeY,  ///< world of a camera's optical frame: x right, y down, z forward
  kPositiveZ,  ///< world of a LiDAR: x forward, y left, z up
};

enum class Viewpoint {
  kTop,    ///< from above: camera world x right, z up in the picture; LiDAR world x right, y up
  kFront,  ///< along the forward axis of the first pose
};

/// World directions of an orthographic view, unit and right-handed.
struct ViewAxes {
  Eigen::Vector3d right;
  Eigen::Vector3d up;         ///< up in the picture
  Eigen::Vector3d to_viewer;  ///< right x up
};

ViewAxes view_axes(Viewpoint viewpoint, UpAxis up);

/// Height over the origin [m] of a world point [m].
double height(const Eigen::Vector3d& point, UpAxis up);

}  // namespace mms
