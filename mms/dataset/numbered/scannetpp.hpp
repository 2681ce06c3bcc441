#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names is the iphone/ folder of a scene of ScanNet++, or the
/// scene.
bool is_scannetpp_layout(const std::vector<std::string>& names);

/// Opens the iPhone's recording of a scene of ScanNet++, with extracted images: rgb/frame_N.jpg,
/// depth/frame_N.png [mm], pose_intrinsic_imu.json with intrinsics of the color images (the first
/// ones count for all) and poses. Frames have the depth images' size; the camera is the same.
/// @throws FileError, DataError.
std::unique_ptr<FrameSource> open_scannetpp(const std::filesystem::path& folder,
                                            const SourceOptions& options);

}  // namespace mms
