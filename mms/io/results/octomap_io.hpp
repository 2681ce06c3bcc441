#pragma once

#include <cstddef>
#include <filesystem>

#include "mms/geometry/voxels/occupancy.hpp"

namespace mms {

/// Writes the voxels as a binary OctoMap (.bt): free, occupied, or unknown.
/// @returns the number of omitted voxels farther than 32768 voxels from the origin, the limit of
/// OctoMap.
/// @throws FileError if the file cannot be written.
std::size_t write_octomap(const std::filesystem::path& path, const OccupancyVoxels& voxels);

}  // namespace mms
