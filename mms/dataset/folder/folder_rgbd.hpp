#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names has color images with their depth images.
/// @param names  sorted
bool is_folder_rgbd_layout(const std::vector<std::string>& names);

/// Opens a folder in the layout of 7-Scenes, 3DMatch, BundleFusion, 3RScan and the sensor tool of
/// ScanNet: X.color.png or .jpg, X.depth.png or .pgm and optional X.pose.txt (4x4 camera-to-world)
/// for every frame X, sorted by the numbers in the names. Other names with the word color
/// or rgb, and depth in its place, are pairs, too, as rgb_1.png and depth_1.png. Depth 65535 means
/// no return. Optional masks/. The calibration is that of calibration.yaml, else of info.txt or
/// _info.txt (`read_sensor_info`), else of camera-intrinsics.txt in the folder or above it, else
/// that of 7-Scenes for its names.
/// @throws FileError, DataError; ConfigError for an invalid calibration.yaml.
std::unique_ptr<FrameSource> open_folder_rgbd(const std::filesystem::path& folder,
                                              const SourceOptions& options);

}  // namespace mms
