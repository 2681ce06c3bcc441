#pragma once

#include <Eigen/Core>

namespace mms {

/// Up direction of a world frame.
enum class UpAxis {
  kNegativeY,  ///< world of a camera's optical frame: x right, y down, z forward
  kPositiveZ,  ///< world of a LiDAR: x forward, y left, z up
};

enum class Viewpoint {
  kTop,    ///< top view: camera world x right, z up in the image; LiDAR world x right, y up
  kFront,  ///< along the forward axis of the first pose
};

/// Directions of an orthographic view in the world frame, unit and right-handed.
struct ViewAxes {
  Eigen::Vector3d right;
  Eigen::Vector3d up;         ///< up in the image
  Eigen::Vector3d to_viewer;  ///< right x up
};

ViewAxes view_axes(Viewpoint viewpoint, UpAxis up);

/// Height above the origin [m] of a world point [m].
double height(const Eigen::Vector3d& point, UpAxis up);

}  // namespace mms
