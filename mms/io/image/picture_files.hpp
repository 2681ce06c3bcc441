#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mms {

/// File name endings of color images, as ".jpg".
const std::vector<std::string>& color_endings();

/// File name endings of depth images.
const std::vector<std::string>& depth_endings();

/// Whether the file name is that of a color image; case does not count.
bool is_picture(const std::filesystem::path& path);

/// Image files of a folder, sorted by name.
/// @throws FileError as `list_folder`.
std::vector<std::filesystem::path> list_pictures(const std::filesystem::path& folder);

/// Path of an image of a COCO file: in `folder`, or else in its subfolder images/.
std::filesystem::path picture_path(const std::filesystem::path& folder, const std::string& name);

}  // namespace mms
