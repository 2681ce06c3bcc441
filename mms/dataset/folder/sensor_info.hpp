#pragma once

#include <filesystem>

#include "mms/core/calibration.hpp"

namespace mms {

/// Both cameras of a recording made by the sensor tools of ScanNet, BundleFusion and 3RScan.
struct SensorInfo {
  CameraIntrinsics color;
  CameraIntrinsics depth;
  double depth_scale = 1000.0;  ///< [1/m]
  bool has_extrinsics = false;  ///< whether a camera is not at the origin of the sensor
};

/// Reads info.txt or _info.txt: lines "m_depthWidth = 640". Sizes, camera matrices and the depth
/// scale of both cameras are required.
/// @throws FileError if it cannot be read; DataError naming the entry that is missing or invalid.
SensorInfo read_sensor_info(const std::filesystem::path& file);

}  // namespace mms
