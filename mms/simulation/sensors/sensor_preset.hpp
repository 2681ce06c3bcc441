#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string_view>

#include "mms/core/calibration.hpp"
#include "mms/simulation/sensors/color_sensor.hpp"
#include "mms/simulation/sensors/depth_sensor.hpp"
#include "mms/simulation/sensors/lidar_sensor.hpp"

namespace mms {

/// A sensor head: colour camera and either a depth camera or a LiDAR. The sensor frame is the
/// camera's optical frame with a depth camera and the LiDAR's frame with a LiDAR. Depth images are
/// aligned with the colour camera: the same pixels, the same lens.
struct SensorPreset {
  std::string_view name;
  ColorSensor color;
  std::optional<DepthSensor> depth;
  std::optional<LidarSensor> lidar;
  /// Takes LiDAR points (x forward, y left, z up) to the camera's optical frame; identity without
  /// a LiDAR.
  Eigen::Isometry3d T_camera_lidar = Eigen::Isometry3d::Identity();
  double hz = 30.0;             ///< frames a second, of the colour camera too
  double depth_scale = 1000.0;  ///< units of depth images per metre
};

/// Names of all presets: l515, d435, kinect, lidar16, lidar64, livox.
std::span<const std::string_view> sensor_names();

/// @throws DataError naming the known ones for another name.
SensorPreset sensor_preset(std::string_view name);

}  // namespace mms
