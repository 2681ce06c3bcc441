#pragma once

#include <filesystem>
#include <string>

namespace mms {

/// @throws FileError when there is no such file or it is a folder; DataError when it is empty or no
///         bag of version 2.0, or has no index.
void check_bag_file(const std::filesystem::path& path);

/// Says why a bag cannot be opened, and which topics it has.
/// @param reason  what rosbag says of it
/// @throws DataError always.
[[noreturn]] void fail_bag(const std::filesystem::path& path, const std::string& reason);

}  // namespace mms
