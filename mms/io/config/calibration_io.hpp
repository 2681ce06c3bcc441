#pragma once

#include <filesystem>

#include "mms/core/calibration.hpp"

namespace mms {

/// Reads calibration.yaml. With a camera: fx fy cx cy width height [px] and depth_scale (depth
/// image units per metre) are required; distortion (k1 k2 p1 p2 and perhaps k3) is optional,
/// and so is max_depth, the farthest depth worth mapping [m]. T_camera_lidar (3x4 or 4x4, row by
/// row, [m]) is optional and may stand alone.
/// @throws FileError when the file cannot be read.
/// @throws ConfigError naming file:line and key for an unknown or missing key, a wrong type, a
///         value out of range, or a matrix that is no rigid transform.
Calibration read_calibration(const std::filesystem::path& path);

/// Writes what `read_calibration` reads back exactly. @throws FileError when it cannot be written.
void write_calibration(const std::filesystem::path& path, const Calibration& calibration);

}  // namespace mms
