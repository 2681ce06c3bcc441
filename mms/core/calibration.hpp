#pragma once

#include <array>

#include <optional>

#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"

namespace mms {

/// Pinhole camera with the Brown-Conrady distortion model (k1 k2 p1 p2 k3, order of OpenCV). Pixel
/// centers have integer coordinates. geometry/camera.hpp projects with it.
struct CameraIntrinsics {
  double fx = 0.0;                     ///< focal length [px]
  double fy = 0.0;                     ///< focal length [px]
  double cx = 0.0;                     ///< principal point [px]
  double cy = 0.0;                     ///< principal point [px]
  int width = 0;                       ///< [px]
  int height = 0;                      ///< [px]
  std::array<double, 5> distortion{};  ///< k1 k2 p1 p2 k3; zeros: none

  bool operator==(const CameraIntrinsics&) const = default;
};

/// A depth camera with a place of its own beside the color camera.
struct DepthCamera {
  CameraIntrinsics camera;                 ///< of the depth images
  Transform<Camera, Depth> T_color_depth;  ///< extrinsics
};

/// Mounting of wheels and gyroscope. Unknown extrinsics: `localization/motion/motion_sensors`.
struct MotionCalibration {
  std::optional<Transform<Sensor, Base>> T_sensor_base;  ///< of the wheels' frame
  std::optional<Transform<Sensor, Imu>> T_sensor_imu;    ///< of the gyroscope
  Duration wheel_delay{0};  ///< by which stamps of wheels are later than the frames' clock
  Duration imu_delay{0};    ///< the same of the gyroscope

  /// Whether nothing is known.
  bool empty() const {
    return !T_sensor_base && !T_sensor_imu && wheel_delay == Duration(0) &&
           imu_delay == Duration(0);
  }
};

/// Calibration of the sensor of a recording.
struct Calibration {
  std::optional<CameraIntrinsics> camera;   ///< absent for LiDAR without a camera
  Transform<Camera, Lidar> T_camera_lidar;  ///< extrinsics, used if a frame has image and scan
  double depth_scale = 1000.0;              ///< depth image units per meter
  std::optional<double> max_depth;          ///< largest depth used for mapping [m], if known
  /// Of depth images that are not registered to `camera`; recordings register them, so the
  /// calibration of a frame has none.
  std::optional<DepthCamera> depth_camera;
  MotionCalibration motion;  ///< of wheels and gyroscope
};

}  // namespace mms
