#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mms/io/cloud/point_cloud_file.hpp"

namespace mms {

/// Reads the vertices of a PLY file, ascii or binary_little_endian; ignores other properties and
/// elements after the vertices.
/// @throws FileError if the file cannot be read; DataError with the header line for a damaged or
/// unsupported header, a truncated file, or a value out of range.
PointCloudFile read_ply(const std::filesystem::path& path);

/// Writes binary_little_endian PLY.
/// @param comments  lines of its header
/// @throws FileError if the file cannot be written; DataError if the cloud's vectors differ in
/// size.
void write_ply(const std::filesystem::path& path, const PointCloudFile& cloud,
               const std::vector<std::string>& comments = {});

}  // namespace mms
