#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mms/dataset/lidar/scan_format.hpp"

namespace mms {

/// Data sets with files, stamps or ground truth of their own.
enum class ScanDataset { kKitti, kKittiRaw, kMulRan, kNclt, kNewerCollege, kHeLiPR, kOther };

/// The scans of a recording.
struct ScanLayout {
  const char* name = "";  ///< for messages
  ScanDataset dataset = ScanDataset::kOther;
  std::vector<std::filesystem::path> scans;  ///< in the order of their names' numbers
  ScanFormat format;                         ///< of kOther and kKitti still to be recognized
};

/// Whether a folder with these file names has scans.
bool has_scans(const std::vector<std::string>& names);

/// Finds the scans of a recording in its folder or one below it.
/// @throws DataError if there are none.
ScanLayout find_scan_layout(const std::filesystem::path& folder);

/// The lines of the scans, from 0, in a file that has one for each scan of a sequence: all in their
/// order, or those of the names' numbers if the folder has a part of the sequence. Empty if neither
/// is possible.
/// @param lines  of the file
std::vector<std::size_t> lines_of_scans(const std::vector<std::filesystem::path>& scans,
                                        std::size_t lines);

}  // namespace mms
