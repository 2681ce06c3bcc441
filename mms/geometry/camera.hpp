#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/core/calibration.hpp"

namespace mms {

/// Pinhole projection with Brown-Conrady distortion (k1 k2 p1 p2 k3), formulas of OpenCV. Points in
/// the camera frame [m], pixels with integer centers.
class CameraModel {
 public:
  /// @throws DataError if a focal length, the principal point or the size is invalid.
  explicit CameraModel(const CameraIntrinsics& intrinsics);

  const CameraIntrinsics& intrinsics() const { return intrinsics_; }

  /// Pixel of a point; valid only if point.z() > 0 and `in_lens_range`.
  Eigen::Vector2d project(const Eigen::Vector3d& point) const;

  /// `project` with its 2x3 derivative with respect to the point.
  Eigen::Vector2d project(const Eigen::Vector3d& point,
                          Eigen::Matrix<double, 2, 3>& jacobian) const;

  /// Point on the pixel's ray at z = 1; undistorted by Newton's method.
  Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;

  /// Whether the point is within the angle at which the distortion polynomial is monotonic.
  bool in_lens_range(const Eigen::Vector3d& point) const;

  /// Rays at z = 1 of all pixels, row-major.
  std::vector<Eigen::Vector3f> ray_table() const;

 private:
  CameraIntrinsics intrinsics_;
  bool distorted_ = false;
  double max_radius2_ = 0.0;
};

/// Camera of an image downsampled by `stride` (blocks of stride x stride pixels; the block's center
/// is the new pixel's center); sizes are rounded down.
CameraIntrinsics downscaled(const CameraIntrinsics& camera, int stride);

}  // namespace mms
