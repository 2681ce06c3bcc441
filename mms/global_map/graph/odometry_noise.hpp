#pragma once

#include <Eigen/Geometry>

#include "mms/geometry/se3.hpp"

namespace mms {

/// Information of a motion measured by odometry, with an honest noise floor: registration's own
/// covariance assumes independent residuals and is far too small.
/// @param motion      between two nodes of the pose graph
/// @param after_lost  whether the sensor was lost in between, so that the motion is a guess
Matrix6d odometry_information(const Eigen::Isometry3d& motion, bool after_lost);

/// Information of the motion from the last keyframe of a session to the first one of the next: so
/// little that it only keeps the pose graph solvable.
Matrix6d unknown_motion_information();

}  // namespace mms
