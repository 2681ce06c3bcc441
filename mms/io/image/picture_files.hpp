#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mms {

/// Whether the file name is that of a PNG or JPEG image.
bool is_picture(const std::filesystem::path& path);

/// Image files of a folder, sorted by name.
/// @throws FileError as `list_folder`.
std::vector<std::filesystem::path> list_pictures(const std::filesystem::path& folder);

/// Path of an image of a COCO file: in `folder`, or else in its subfolder images/.
std::filesystem::path picture_path(const std::filesystem::path& folder, const std::string& name);

}  // namespace mms
