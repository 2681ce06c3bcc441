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

/// A sensor head: a color camera and either a depth camera or a LiDAR. The sensor frame is the
/// camera's optical frame with a depth camera and the LiDAR's frame with a LiDAR. Depth images are
/// registered to the color camera.
struct SensorPreset {
  std::string_view name;
  ColorSensor color;
  std::optional<DepthSensor> depth;
  std::optional<LidarSensor> lidar;
  /// Transform from LiDAR (x forward, y left, z up) to the camera's optical frame; identity without
  /// a LiDAR.
  Eigen::Isometry3d T_camera_lidar = Eigen::Isometry3d::Identity();
  double hz = 30.0;             ///< frame rate [Hz], also of the color camera
  double depth_scale = 1000.0;  ///< depth image units per meter
};

/// Names of all presets: l515, d435, kinect, lidar16, lidar64, livox.
std::span<const std::string_view> sensor_names();

/// @throws DataError with the known names for an unknown one.
SensorPreset sensor_preset(std::string_view name);

}  // namespace mms
