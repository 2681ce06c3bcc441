#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/core/calibration.hpp"

namespace mms {

/// Pinhole projection with Brown-Conrady distortion (k1 k2 p1 p2 k3), OpenCV's formulas.
/// Points in the camera frame [m], pixels with integer centres.
class CameraModel {
 public:
  /// @throws DataError when a focal length, the principal point or the size makes no camera.
  explicit CameraModel(const CameraIntrinsics& intrinsics);

  const CameraIntrinsics& intrinsics() const { return intrinsics_; }

  /// Pixel of a point; meaningful only where point.z() > 0 and `in_lens_range` holds.
  Eigen::Vector2d project(const Eigen::Vector3d& point) const;

  /// `project` and its 2x3 derivative by the point.
  Eigen::Vector2d project(const Eigen::Vector3d& point,
                          Eigen::Matrix<double, 2, 3>& jacobian) const;

  /// Point on the pixel's ray with z = 1 (distortion undone by Newton's method).
  Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;

  /// False for points so far off the optical axis that the distortion polynomial folds back.
  bool in_lens_range(const Eigen::Vector3d& point) const;

  /// Rays with z = 1 of all pixels, row-major.
  std::vector<Eigen::Vector3f> ray_table() const;

 private:
  CameraIntrinsics intrinsics_;
  bool distorted_ = false;
  double max_radius2_ = 0.0;
};

/// Camera of the image made of every `stride`-th pixel averaged in stride x stride blocks (the
/// block's centre is the new pixel's centre); sizes are rounded down.
CameraIntrinsics downscaled(const CameraIntrinsics& camera, int stride);

}  // namespace mms
