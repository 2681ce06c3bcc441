#pragma once

#include <filesystem>

#include "mms/io/cloud/point_cloud_file.hpp"

namespace mms {

/// Reads a PCD file with DATA ascii or binary. Fields: x y z, normal_x normal_y normal_z, rgb
/// (packed), label and observations; ignores others.
/// @throws FileError, DataError as `read_ply`.
PointCloudFile read_pcd(const std::filesystem::path& path);

/// Writes PCD 0.7 with binary data.
/// @throws FileError, DataError as `write_ply`.
void write_pcd(const std::filesystem::path& path, const PointCloudFile& cloud);

}  // namespace mms
