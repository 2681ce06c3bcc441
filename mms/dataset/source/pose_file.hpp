#pragma once

#include <filesystem>
#include <vector>

#include "mms/dataset/source/rgbd_source.hpp"

namespace mms {

/// Adds the ground-truth pose of every frame with a file: 4x4, row-major, camera-to-world. Files
/// without a valid pose are skipped; data sets mark unknown poses by NaN or infinite numbers. One
/// warning has their number.
/// @param files  parallel to `recording.frames`; they may be missing
void add_pose_files(RgbdRecording& recording, const std::vector<std::filesystem::path>& files);

}  // namespace mms
