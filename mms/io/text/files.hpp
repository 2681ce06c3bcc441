#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mms {

/// All bytes of a regular file.
/// @param limit  largest size [B]
/// @throws FileError if it is missing, a folder, larger than that, or cannot be read.
std::string read_file(const std::filesystem::path& path, std::uint64_t limit = UINT64_MAX);

/// Sorted names of the entries of a folder, equal on every machine.
/// @throws FileError if it is missing, not a folder, or cannot be read.
std::vector<std::string> list_folder(const std::filesystem::path& folder);

/// Creates an output folder and its parents.
/// @returns whether it was created.
/// @throws FileError if it cannot be created or is a file.
bool make_folder(const std::filesystem::path& folder);

}  // namespace mms
