#pragma once

#include "mms/geometry/se3.hpp"

namespace mms {

/// Gauss-Newton normal equations of a weighted sum of squared residuals for a right perturbation T
/// exp(x) of the pose, x = (translation [m], rotation [rad]) in the sensor frame.
struct NormalEquations {
  Matrix6d information = Matrix6d::Zero();  ///< sum of w J^T J
  Vector6d gradient = Vector6d::Zero();     ///< sum of w J^T r
  double cost = 0.0;                        ///< sum of w r^2
  int inliers = 0;                          ///< number of inliers, set by the caller

  void add(double residual, const Vector6d& jacobian, double weight) {
    const Vector6d weighted = weight * jacobian;
    information.noalias() += weighted * jacobian.transpose();
    gradient += residual * weighted;
    cost += weight * residual * residual;
  }

  NormalEquations& operator+=(const NormalEquations& other) {
    information += other.information;
    gradient += other.gradient;
    cost += other.cost;
    inliers += other.inliers;
    return *this;
  }
};

/// Cauchy weight of a residual in units of its standard deviation: 1 / (1 + (r/c)^2).
inline double cauchy_weight(double normalized_residual, double c) {
  const double ratio = normalized_residual / c;
  return 1.0 / (1.0 + ratio * ratio);
}

}  // namespace mms
