#pragma once

#include <Eigen/Geometry>

namespace mms {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// SE(3) as a Lie group. Tangent vectors are (translation [m], rotation [rad]); `exp` and `log` are
/// inverse for rotations below pi. Formulas: Barfoot, State Estimation for Robotics, chapter 7
/// (left Jacobian V, adjoint), with series for small angles.
namespace se3 {

/// Skew-symmetric matrix of the cross product: hat(a) * b = a x b.
Eigen::Matrix3d hat(const Eigen::Vector3d& v);

Eigen::Isometry3d exp(const Vector6d& tangent);
Vector6d log(const Eigen::Isometry3d& transform);

/// Ad_T with T exp(x) = exp(Ad_T x) T.
Matrix6d adjoint(const Eigen::Isometry3d& transform);

/// Interpolation from identity (t = 0) to `transform` (t = 1) along the geodesic.
Eigen::Isometry3d interpolate(const Eigen::Isometry3d& transform, double t);

/// `transform` with re-orthonormalized rotation, against numerical drift.
Eigen::Isometry3d normalized(const Eigen::Isometry3d& transform);

/// Rotation angle [rad], in [0, pi].
double angle(const Eigen::Isometry3d& transform);

}  // namespace se3
}  // namespace mms
