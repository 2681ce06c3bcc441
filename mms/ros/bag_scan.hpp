#pragma once

#include <filesystem>
#include <vector>

#include "mms/ros/bag_topic.hpp"

namespace mms {

/// Content of a bag without index, found by sequential reading.
struct BagScan {
  bool is_bag = false;           ///< has the header of a bag of version 2.0
  bool truncated = false;        ///< it ends within a record
  bool compressed = false;       ///< has compressed chunks, whose topics are unknown
  std::vector<BagTopic> topics;  ///< sorted by name, with message counts
};

/// Reads the records of a bag sequentially up to the first damage.
/// @throws FileError if the file cannot be read.
BagScan scan_bag(const std::filesystem::path& path);

}  // namespace mms
