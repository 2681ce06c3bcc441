#pragma once

#include <array>

#include <optional>

#include "mms/core/transform.hpp"

namespace mms {

/// Pinhole camera with the five-coefficient Brown-Conrady lens model (k1 k2 p1 p2 k3, OpenCV's
/// order). Pixel centres have integer coordinates. What it does is in geometry/camera.hpp.
struct CameraIntrinsics {
  double fx = 0.0;  ///< focal length [px]
  double fy = 0.0;  ///< focal length [px]
  double cx = 0.0;  ///< principal point [px]
  double cy = 0.0;  ///< principal point [px]
  int width = 0;    ///< [px]
  int height = 0;   ///< [px]
  std::array<double, 5> distortion{};

  bool operator==(const CameraIntrinsics&) const = default;
};

/// Everything fixed about the sensor that a recording brings along.
struct Calibration {
  std::optional<CameraIntrinsics> camera;   ///< absent for LiDAR without a camera
  Transform<Camera, Lidar> T_camera_lidar;  ///< extrinsics, used where both are there
  double depth_scale = 1000.0;              ///< depth image units per metre
  std::optional<double> max_depth;          ///< farthest depth worth mapping [m], if it is known
};

}  // namespace mms
