#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names is a trajectory of TartanAir.
bool is_tartan_air_layout(const std::vector<std::string>& names);

/// Opens a trajectory of TartanAir: image_left/N_left.png, depth_left/N_left_depth.npy [m],
/// optional pose_left.txt (tx ty tz qx qy qz qw a line, axes forward, right, down). Its camera has
/// 640x480 px and a focal length of 320 px.
/// @throws FileError, DataError.
std::unique_ptr<FrameSource> open_tartan_air(const std::filesystem::path& folder,
                                             const SourceOptions& options);

}  // namespace mms
