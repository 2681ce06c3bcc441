#pragma once

#include <filesystem>
#include <vector>

#include "mms/core/frame.hpp"

namespace mms {

/// Reads a KITTI velodyne scan: x y z [m] and reflectance as little-endian float32, point by point.
/// NaN and infinite points are kept.
/// @throws FileError when the file cannot be read; DataError when it is empty or its size is no
///         multiple of a point's 16 bytes.
LidarScan read_kitti_scan(const std::filesystem::path& path);

/// Writes what `read_kitti_scan` reads back; without intensities the reflectance is 0.
/// @throws FileError when the file cannot be written, DataError when there are intensities, but not
///         as many as points.
void write_kitti_scan(const std::filesystem::path& path, const LidarScan& scan);

/// Reads the times of a scan's points since the scan's stamp [s], little-endian float32 each.
/// @throws FileError when the file cannot be read; DataError when its size is no multiple of four
///         bytes or a time is not finite.
std::vector<float> read_point_times(const std::filesystem::path& path);

/// Writes what `read_point_times` reads back. @throws FileError
void write_point_times(const std::filesystem::path& path, const std::vector<float>& times);

}  // namespace mms
