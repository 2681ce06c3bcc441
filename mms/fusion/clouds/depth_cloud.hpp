#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/fusion/config/fusion_config.hpp"

namespace mms {

/// Turns depth images into organised clouds, one point for every stride x stride block of pixels.
class DepthCloudBuilder {
 public:
  explicit DepthCloudBuilder(const FusionConfig& config) : config_(config) {}

  /// The cloud of an RGB-D frame in the camera frame. Every point with a return in range is static,
  /// the others invalid. A block's point is the mean of its returns that lie on the surface of the
  /// nearest one: averaging over an occlusion border would make points in free space.
  /// @throws DataError when calibration, colour and depth disagree in size
  LabeledCloud build(const Frame& frame);

 private:
  void prepare(const CameraIntrinsics& camera);

  FusionConfig config_;
  int stride_ = 0;                          ///< of the ray table
  CameraIntrinsics full_camera_;            ///< of the image the ray table belongs to
  CameraIntrinsics camera_;                 ///< of the cloud
  std::vector<Eigen::Vector3f> ray_table_;  ///< z = 1, of the cloud's pixels
};

}  // namespace mms
