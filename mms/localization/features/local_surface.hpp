#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "mms/geometry/principal_axes.hpp"

namespace mms {

/// Plane through points by their principal axes.
class PlaneFit {
 public:
  /// @param origin  a point near the others; sums are relative to it to keep float digits
  explicit PlaneFit(const Eigen::Vector3f& origin) : origin_(origin) {}

  void add(const Eigen::Vector3f& point) { offsets_.add(point - origin_); }

  int count() const { return offsets_.count(); }

  struct Plane {
    Eigen::Vector3f mean;
    Eigen::Vector3f normal;  ///< unit, towards the sensor at the origin of coordinates
    float thickness = 0.0F;  ///< rms distance of the points from the plane [m]
    float width = 0.0F;      ///< rms extent along the second principal direction [m]
  };

  /// Needs three points that are not collinear.
  Plane solve() const {
    const auto axes = principal_axes(offsets_.covariance(), EigenMethod::kClosedForm);
    const Eigen::Vector3f mean = origin_ + offsets_.mean();
    const Eigen::Vector3f to_sensor = -mean;
    return {mean, oriented(axes.smallest(), to_sensor),
            std::sqrt(std::max(0.0F, axes.variances(0))),
            std::sqrt(std::max(0.0F, axes.variances(1)))};
  }

 private:
  Eigen::Vector3f origin_;
  PointSums<float, 3> offsets_;
};

}  // namespace mms
