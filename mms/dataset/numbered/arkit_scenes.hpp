#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names is a scan of ARKitScenes.
bool is_arkit_scenes_layout(const std::vector<std::string>& names);

/// Opens a scan of ARKitScenes (raw): lowres_wide/VIDEO_STAMP.png, lowres_depth/VIDEO_STAMP.png
/// [mm], lowres_wide_intrinsics/VIDEO_STAMP.pincam (width height fx fy cx cy; the first one counts
/// for all), optional lowres_wide.traj (stamp, axis times angle, translation of world-to-camera).
/// @throws FileError, DataError.
std::unique_ptr<FrameSource> open_arkit_scenes(const std::filesystem::path& folder,
                                               const SourceOptions& options);

}  // namespace mms
