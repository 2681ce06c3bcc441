#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these names in it holds 7-Scenes' kind of files.
bool is_folder_rgbd_layout(const std::vector<std::string>& names);

/// Opens a folder in the manner of 7-Scenes: X.color.png or .jpg, X.depth.png and optional
/// X.pose.txt (4x4 camera-to-world) for every frame X, in the order of the names at 30 Hz. Depth
/// 65535 means no return. Optional masks/ and calibration.yaml; 7-Scenes' default otherwise.
/// @throws FileError, DataError; ConfigError for a faulty calibration.yaml.
std::unique_ptr<FrameSource> open_folder_rgbd(const std::filesystem::path& folder,
                                              const SourceOptions& options);

}  // namespace mms
