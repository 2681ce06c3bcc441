#pragma once

#include <filesystem>
#include <string>

namespace mms {

/// @throws FileError if the file does not exist or is a folder; DataError if it is empty, not a bag
/// of version 2.0, or has no index.
void check_bag_file(const std::filesystem::path& path);

/// Reports why a bag cannot be opened, and its topics.
/// @param reason  message of rosbag
/// @throws DataError always.
[[noreturn]] void fail_bag(const std::filesystem::path& path, const std::string& reason);

}  // namespace mms
