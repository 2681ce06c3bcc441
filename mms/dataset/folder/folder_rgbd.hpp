#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names has the layout of 7-Scenes.
bool is_folder_rgbd_layout(const std::vector<std::string>& names);

/// Opens a folder in the layout of 7-Scenes: X.color.png or .jpg, X.depth.png and optional
/// X.pose.txt (4x4 camera-to-world) for every frame X, sorted by name, at 30 Hz. Depth 65535 means
/// no return. Optional masks/ and calibration.yaml (default: that of 7-Scenes).
/// @throws FileError, DataError; ConfigError for an invalid calibration.yaml.
std::unique_ptr<FrameSource> open_folder_rgbd(const std::filesystem::path& folder,
                                              const SourceOptions& options);

}  // namespace mms
