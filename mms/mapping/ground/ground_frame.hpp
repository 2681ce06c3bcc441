#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

namespace mms {

/// The world's upright axis and headings about it. A heading of 0 is the world's z axis (a camera's
/// view) or, where that is upright, its x axis, projected to the horizontal.
class GroundFrame {
 public:
  /// @param up     in the world frame; any length but 0
  /// @param floor  height of the floor along it over the world's origin [m], where known
  explicit GroundFrame(const Eigen::Vector3d& up, std::optional<double> floor = {})
      : up_(up.normalized()), floor_(floor) {
    const Eigen::Vector3d ahead =
        std::abs(up_.z()) < kMaxUprightZ ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    ahead_ = (ahead - up_.dot(ahead) * up_).normalized();
    left_ = up_.cross(ahead_);
  }

  const Eigen::Vector3d& up() const { return up_; }
  const std::optional<double>& floor() const { return floor_; }

  Eigen::Vector3d horizontal(const Eigen::Vector3d& v) const { return v - up_.dot(v) * up_; }

  /// Heading of the horizontal part of a direction [rad].
  double heading_of(const Eigen::Vector3d& v) const {
    return std::atan2(left_.dot(v), ahead_.dot(v));
  }

  /// Axes of a box with that heading, as columns: along it, to its left, up.
  Eigen::Matrix3d axes(double heading) const {
    Eigen::Matrix3d axes;
    axes.col(0) = std::cos(heading) * ahead_ + std::sin(heading) * left_;
    axes.col(1) = up_.cross(axes.col(0));
    axes.col(2) = up_;
    return axes;
  }

 private:
  /// [-]: z of `up` from which z is upright. Source: 45 degrees.
  static constexpr double kMaxUprightZ = 0.7;

  Eigen::Vector3d up_;
  std::optional<double> floor_;
  Eigen::Vector3d ahead_;
  Eigen::Vector3d left_;
};

}  // namespace mms
