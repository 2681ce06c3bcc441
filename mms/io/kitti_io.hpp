#pragma once

#include <filesystem>

#include "mms/core/frame.hpp"

namespace mms {

/// Reads a KITTI velodyne scan: x y z [m] and reflectance as little-endian float32, point by point.
/// NaN and infinite points are kept.
/// @throws FileError when the file cannot be read; DataError when it is empty or its size is no
///         multiple of a point's 16 bytes.
LidarScan read_kitti_scan(const std::filesystem::path& path);

}  // namespace mms
