#include "mms/ros/bag_fault.hpp"

#include "mms/core/error.hpp"
#include "mms/ros/bag_reader.hpp"
#include "mms/ros/bag_scan.hpp"

namespace mms {

bool is_bag_name(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  return name.ends_with(".bag") || name.ends_with(".bag.active");
}

void check_bag_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    throw FileError(path.string(), "no such file");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    throw FileError(path.string(), "is not a file, expected a bag file");
  }
  if (std::filesystem::file_size(path) == 0) throw DataError(path.string(), "is empty, 0 bytes");
}

void fail_bag(const std::filesystem::path& path, const std::string& reason) {
  const BagScan scan = scan_bag(path);
  if (!scan.is_bag) {
    throw DataError(path.string(), "is not a ROS 1 bag of version 2.0: " + reason,
                    "a bag begins with '#ROSBAG V2.0'");
  }
  std::string found = scan.topics.empty() && scan.compressed
                          ? "its chunks are compressed, so its topics are unknown"
                          : "it has " + listed(scan.topics);
  const bool unindexed = reason.find("unindexed") != std::string::npos;
  throw DataError(path.string(),
                  (scan.truncated ? "is truncated: "
                   : unindexed    ? "has no index because it was not closed: "
                                  : "cannot be read (" + reason + "): ") +
                      found,
                  "rosbag reindex " + path.filename().string() + " recovers the complete part");
}

}  // namespace mms
