#pragma once

#include <filesystem>
#include <vector>

#include "mms/ros/bag_topic.hpp"

namespace mms {

/// What is left of a bag that has no index, by reading it from its beginning.
struct BagScan {
  bool is_bag = false;           ///< it begins as a bag of version 2.0 does
  bool truncated = false;        ///< it ends within a record
  bool compressed = false;       ///< some chunks are, whose topics are not known
  std::vector<BagTopic> topics;  ///< by name, with the messages counted
};

/// Reads the records of a bag one by one, however damaged it is. @throws FileError when the file
/// cannot be read.
BagScan scan_bag(const std::filesystem::path& path);

}  // namespace mms
