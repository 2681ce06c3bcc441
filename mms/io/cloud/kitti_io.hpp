#pragma once

#include <filesystem>
#include <vector>

#include "mms/core/frame.hpp"

namespace mms {

/// Writes a KITTI velodyne scan: x y z [m] and reflectance per point as little-endian float32;
/// without intensities the reflectance is 0.
/// @throws FileError if the file cannot be written; DataError if the number of intensities is not
/// that of the points.
void write_kitti_scan(const std::filesystem::path& path, const LidarScan& scan);

/// Reads the stamps of a scan's points relative to the scan's stamp [s], little-endian float32.
/// @throws FileError if the file cannot be read; DataError if its size is not a multiple of four
/// bytes or a time is not finite.
std::vector<float> read_point_times(const std::filesystem::path& path);

/// Inverse of `read_point_times`.
/// @throws FileError
void write_point_times(const std::filesystem::path& path, const std::vector<float>& times);

}  // namespace mms
