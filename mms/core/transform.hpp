#pragma once

#include <Eigen/Geometry>

namespace mms {

/// Coordinate frames a transform can go between. Camera is the optical frame: x right, y down,
/// z forward. Sensor is the frame of the cloud that is localised: the camera's for RGB-D, the
/// LiDAR's for LiDAR. World is the sensor frame of the first localised frame.
struct World {};
struct Camera {};
struct Lidar {};
struct Sensor {};

/// Rigid transform that takes coordinates in `Source` to coordinates in `Target`; a variable of
/// type Transform<World, Sensor> is named T_world_sensor. Composition with mismatched frames does
/// not compile. Translations in metres.
template <class Target, class Source>
class Transform {
 public:
  Transform() : isometry_(Eigen::Isometry3d::Identity()) {}
  explicit Transform(const Eigen::Isometry3d& isometry) : isometry_(isometry) {}

  static Transform identity() { return Transform(); }

  const Eigen::Isometry3d& isometry() const { return isometry_; }
  Eigen::Matrix3d rotation() const { return isometry_.linear(); }
  Eigen::Vector3d translation() const { return isometry_.translation(); }

  Transform<Source, Target> inverse() const {
    return Transform<Source, Target>(isometry_.inverse());
  }

  template <class Origin>
  Transform<Target, Origin> operator*(const Transform<Source, Origin>& other) const {
    return Transform<Target, Origin>(isometry_ * other.isometry());
  }

  /// Coordinates in Target of a point given in Source [m].
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return isometry_ * point; }

  bool is_finite() const { return isometry_.matrix().allFinite(); }

 private:
  Eigen::Isometry3d isometry_;
};

}  // namespace mms
