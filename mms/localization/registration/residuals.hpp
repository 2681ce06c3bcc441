#pragma once

#include <Eigen/Geometry>

#include "mms/geometry/se3.hpp"

namespace mms {

/// [-]: largest residual of an inlier, in sigmas.
/// Source: three-sigma rule; 99.7 % of normally distributed residuals.
inline constexpr double kInlierSigmas = 3.0;

/// A residual and its derivative by a right perturbation of the pose (see NormalEquations).
struct ScalarResidual {
  double value = 0.0;
  Vector6d jacobian = Vector6d::Zero();
};

struct VectorResidual {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 6> jacobian = Eigen::Matrix<double, 3, 6>::Zero();
};

/// Point-to-plane distance [m] of eq. (4): `point` in the sensor frame, the plane through
/// `on_plane` with unit `normal` in the world frame. Signed; the paper's sum of residuals is taken
/// of squares.
ScalarResidual point_to_plane(const Eigen::Isometry3d& T_world_sensor, const Eigen::Vector3d& point,
                              const Eigen::Vector3d& on_plane, const Eigen::Vector3d& normal);

/// Offset [m] of a point from the line through `on_line` with unit `direction` (world frame). Its
/// norm is the distance of eq. (3); the vector keeps the derivative defined on the line itself,
/// where the norm's is not, and the curvature in both directions across the line.
VectorResidual point_to_line(const Eigen::Isometry3d& T_world_sensor, const Eigen::Vector3d& point,
                             const Eigen::Vector3d& on_line, const Eigen::Vector3d& direction);

}  // namespace mms
