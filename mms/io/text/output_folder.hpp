#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace mms {

/// Makes an output folder, or takes one that has nothing but earlier outputs. Devices, and links to
/// them, are left alone.
/// @param own        names of all files and folders that the caller writes there
/// @param marks      those of them that only this program writes; without any, the rest is not ours
/// @param overwrite  removes earlier outputs
/// @returns whether the folder was created
/// @throws FileError if the folder has other files, or earlier outputs without `overwrite`; if it
/// cannot be created or read, or an output cannot be removed. Then no file was changed.
bool take_output_folder(const std::filesystem::path& folder, std::span<const std::string_view> own,
                        std::span<const std::string_view> marks, bool overwrite);

}  // namespace mms
