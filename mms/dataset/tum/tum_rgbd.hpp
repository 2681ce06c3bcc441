#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names is a TUM-layout sequence, possibly incomplete.
bool is_tum_rgbd_layout(const std::vector<std::string>& names);

/// Opens a TUM-layout sequence: rgb.txt and depth.txt (stamps matched within 0.02 s), or
/// associations.txt, or else the images of rgb/ and depth/ by their names (`add_unlisted_frames`);
/// optional groundtruth.txt, masks/ and calibration.yaml.
/// @throws FileError, DataError if a list is missing, empty or without matches, or there is no
/// calibration; ConfigError for an invalid calibration.yaml.
std::unique_ptr<FrameSource> open_tum_rgbd(const std::filesystem::path& folder,
                                           const SourceOptions& options);

}  // namespace mms
