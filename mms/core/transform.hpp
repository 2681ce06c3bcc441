#pragma once

#include <Eigen/Geometry>

namespace mms {

/// Coordinate frames of transforms. Camera: optical frame, x right, y down, z forward. Depth: that
/// of a depth camera beside it. Sensor: frame of the localized cloud, the camera frame for RGB-D,
/// the LiDAR frame for LiDAR. World: the sensor frame of the first localized frame. Global: that of
/// the map, the world at its first keyframe, corrected by loop closure. Base: that of the wheels, x
/// forward, y left, z up. Odometer: the base's frame where its dead reckoning began. Imu: that of a
/// gyroscope and accelerometer.
struct World {};
struct Global {};
struct Camera {};
struct Depth {};
struct Lidar {};
struct Sensor {};
struct Base {};
struct Odometer {};
struct Imu {};

/// Rigid transform from coordinates in `Source` to coordinates in `Target`; a variable of type
/// Transform<World, Sensor> is named T_world_sensor. Composition of mismatched frames does not
/// compile. Translations in meters.
template <class Target, class Source>
class Transform {
 public:
  /// The identity.
  Transform() : isometry_(Eigen::Isometry3d::Identity()) {}
  /// @param isometry  from Source to Target, translation in [m]
  explicit Transform(const Eigen::Isometry3d& isometry) : isometry_(isometry) {}

  /// Target and Source are the same frame.
  static Transform identity() { return Transform(); }

  /// Without the types of the frames.
  const Eigen::Isometry3d& isometry() const { return isometry_; }
  /// Rotation part, 3x3 orthonormal.
  Eigen::Matrix3d rotation() const { return isometry_.linear(); }
  /// Origin of Source in Target [m].
  Eigen::Vector3d translation() const { return isometry_.translation(); }

  /// From Target to Source.
  Transform<Source, Target> inverse() const {
    return Transform<Source, Target>(isometry_.inverse());
  }

  /// First `other`, then this one.
  template <class Origin>
  Transform<Target, Origin> operator*(const Transform<Source, Origin>& other) const {
    return Transform<Target, Origin>(isometry_ * other.isometry());
  }

  /// Coordinates in Target of a point in Source [m].
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return isometry_ * point; }

  /// Whether no element is NaN or infinite.
  bool is_finite() const { return isometry_.matrix().allFinite(); }

 private:
  Eigen::Isometry3d isometry_;
};

}  // namespace mms
