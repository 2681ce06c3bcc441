#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/geometry/camera.hpp"

namespace mms {

/// Registers depth images to a color camera at another place: each depth pixel is projected as a
/// square of its size, and the nearest one counts for a color pixel. So images of more pixels have
/// no holes, but points that the depth camera does not see have no depth.
class DepthRegistration {
 public:
  /// @throws DataError if a camera is invalid.
  DepthRegistration(const DepthCamera& depth, const CameraIntrinsics& color);

  /// Camera of the images to register.
  const CameraIntrinsics& depth_camera() const { return depth_camera_; }

  /// @param depth  [m], of the size of `depth_camera`; 0, NaN and inf mean no return
  /// @returns depth along the color camera's axis [m], of the size of its images; 0 for no return
  Image<float> apply(const Image<float>& depth) const;

 private:
  struct Footprint;

  /// nullopt outside of the color camera's view.
  std::optional<Footprint> footprint(int x, int y, float depth) const;

  CameraIntrinsics depth_camera_;
  CameraModel color_;
  Eigen::Isometry3d T_color_depth_;
  std::vector<Eigen::Vector3f> centers_;  ///< rays at z = 1 of the pixels' centers, row-major
  std::vector<Eigen::Vector3f> corners_;  ///< and of their upper left corners, one row and column
                                          ///< more than pixels
};

/// Registration for a calibration; nullopt if its depth images are registered.
std::optional<DepthRegistration> make_registration(const Calibration& calibration);

/// Calibration after registration: the same without depth camera.
std::shared_ptr<const Calibration> registered_calibration(
    const std::shared_ptr<const Calibration>& calibration);

}  // namespace mms
