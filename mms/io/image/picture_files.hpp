#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mms {

/// Whether a file's name says that it is a PNG or JPEG picture.
bool is_picture(const std::filesystem::path& path);

/// The pictures of a folder, in the order of their names. @throws FileError as `list_folder` does.
std::vector<std::filesystem::path> list_pictures(const std::filesystem::path& folder);

/// Where the picture of a COCO file is: in `folder`, or else in images/ below it.
std::filesystem::path picture_path(const std::filesystem::path& folder, const std::string& name);

}  // namespace mms
