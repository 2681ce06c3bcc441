#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/dataset/lidar/scan_layout.hpp"
#include "mms/dataset/source/assumed_stamp.hpp"

namespace mms {

/// Stamps of scans.
struct ScanStamps {
  std::vector<Timestamp> stamps;            ///< parallel to the scans
  std::optional<AssumedRate> assumed_rate;  ///< if the recording has none
};

/// Stamps of the scans: times.txt ([s], see lines_of_scans), velodyne_points/timestamps.txt of
/// KITTI raw, or the number at the end of the scans' names (stamp_of_number), or
/// seconds_nanoseconds there. Else 10 Hz are assumed. Adds a fact if there are any.
/// @throws FileError if a file cannot be read; DataError for a damaged line or another number of
/// stamps than scans.
ScanStamps read_scan_stamps(const std::filesystem::path& folder, const ScanLayout& layout,
                            std::vector<std::string>& facts);

}  // namespace mms
