#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these names in it is, or was meant to be, a TUM-layout sequence.
bool is_tum_rgbd_layout(const std::vector<std::string>& names);

/// Opens a TUM-layout sequence: rgb.txt and depth.txt (stamps matched within 0.02 s) or
/// associations.txt; optional groundtruth.txt, masks/ and calibration.yaml.
/// @throws FileError, DataError when a list is missing, empty or without matches, or there is no
///         calibration; ConfigError for a faulty calibration.yaml.
std::unique_ptr<FrameSource> open_tum_rgbd(const std::filesystem::path& folder,
                                           const SourceOptions& options);

}  // namespace mms
