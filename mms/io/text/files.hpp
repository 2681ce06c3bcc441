#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mms {

/// All bytes of a regular file.
/// @throws FileError when it is missing, a folder, or cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Names of everything in a folder, sorted, so that every machine sees the same order.
/// @throws FileError when it is missing, no folder, or cannot be read.
std::vector<std::string> list_folder(const std::filesystem::path& folder);

/// Makes a folder for output, and those above it. @returns whether it was not there before.
/// @throws FileError when it cannot be made or is a file.
bool make_folder(const std::filesystem::path& folder);

}  // namespace mms
