#pragma once

#include <filesystem>

#include "mms/io/cloud/point_cloud_file.hpp"

namespace mms {

/// Reads the vertices of a PLY file, ascii or binary_little_endian; other properties and elements
/// after the vertices are passed over.
/// @throws FileError when the file cannot be read; DataError naming the header line for a damaged
///         or unsupported header, when the file is shorter than its header promises, or when a
///         value does not fit.
PointCloudFile read_ply(const std::filesystem::path& path);

/// Writes binary_little_endian PLY. @throws FileError when the file cannot be written, DataError
/// when the cloud's vectors are not parallel.
void write_ply(const std::filesystem::path& path, const PointCloudFile& cloud);

}  // namespace mms
