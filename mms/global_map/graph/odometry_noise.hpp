#pragma once

#include <Eigen/Geometry>

#include "mms/geometry/se3.hpp"

namespace mms {

/// Information of a motion measured by odometry, with an honest noise floor: registration's own
/// covariance assumes independent residuals and is far too small.
/// @param motion      between two nodes of the pose graph
/// @param after_lost  whether the sensor was lost in between, so that the motion is a guess
Matrix6d odometry_information(const Eigen::Isometry3d& motion, bool after_lost);

}  // namespace mms
