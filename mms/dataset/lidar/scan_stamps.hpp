#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/dataset/lidar/scan_layout.hpp"

namespace mms {

/// Stamps of the scans: times.txt ([s], one a line), velodyne_points/timestamps.txt of KITTI raw,
/// or the number at the end of the scans' names (stamp_of_number), or seconds_nanoseconds there.
/// Else 10 Hz are assumed. Adds a fact.
/// @throws FileError if a file cannot be read; DataError for a damaged line or another number of
/// stamps than scans.
std::vector<Timestamp> read_scan_stamps(const std::filesystem::path& folder,
                                        const ScanLayout& layout, std::vector<std::string>& facts);

}  // namespace mms
