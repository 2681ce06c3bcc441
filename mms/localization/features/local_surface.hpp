#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace mms {

/// Accumulates points and fits a plane to them by principal components.
class PlaneFit {
 public:
  /// @param origin  a point near the others; sums are relative to it to keep float digits
  explicit PlaneFit(const Eigen::Vector3f& origin) : origin_(origin) {}

  void add(const Eigen::Vector3f& point) {
    const Eigen::Vector3f d = point - origin_;
    sum_ += d;
    outer_ += d * d.transpose();
    ++count_;
  }

  int count() const { return count_; }

  struct Plane {
    Eigen::Vector3f mean;
    Eigen::Vector3f normal;  ///< unit, towards the sensor at the origin of coordinates
    float thickness;         ///< rms distance of the points from the plane [m]
    float width;             ///< rms extent along the second principal direction [m]
  };

  /// Meaningful from three points that are not in line.
  Plane solve() const {
    const auto n = static_cast<float>(count_);
    const Eigen::Vector3f offset = sum_ / n;
    const Eigen::Matrix3f covariance = outer_ / n - offset * offset.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> eigen;
    eigen.computeDirect(covariance);
    Plane plane;
    plane.mean = origin_ + offset;
    plane.normal = eigen.eigenvectors().col(0);
    if (plane.normal.dot(plane.mean) > 0.0F) plane.normal = -plane.normal;
    plane.thickness = std::sqrt(std::max(0.0F, eigen.eigenvalues()(0)));
    plane.width = std::sqrt(std::max(0.0F, eigen.eigenvalues()(1)));
    return plane;
  }

 private:
  Eigen::Vector3f origin_;
  Eigen::Vector3f sum_ = Eigen::Vector3f::Zero();
  Eigen::Matrix3f outer_ = Eigen::Matrix3f::Zero();
  int count_ = 0;
};

}  // namespace mms
