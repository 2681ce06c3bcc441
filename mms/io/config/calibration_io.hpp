#pragma once

#include <filesystem>

#include "mms/core/calibration.hpp"

namespace mms {

/// Reads calibration.yaml. With a camera: fx fy cx cy width height [px] and depth_scale (depth
/// image units per meter) are required; distortion (k1 k2 p1 p2 [k3]) and max_depth, the largest
/// depth used for mapping [m], are optional, as is depth_camera, a group with the same keys of a
/// camera and T_color_depth for depth images that are not registered. T_camera_lidar (3x4 or 4x4,
/// row-major, [m]) is optional, as are T_sensor_base, T_sensor_imu, wheel_delay and imu_delay [s]
/// of wheels and gyroscope; a file without a camera may have some of these alone.
/// @throws FileError if the file cannot be read.
/// @throws ConfigError with file:line and key for an unknown or missing key, a wrong type, a value
/// out of range, or a matrix that is not a rigid transform.
Calibration read_calibration(const std::filesystem::path& path);

/// Inverse of `read_calibration`, without loss.
/// @throws FileError if the file cannot be written.
void write_calibration(const std::filesystem::path& path, const Calibration& calibration);

}  // namespace mms
