#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names is a recording in the layout of EuRoC, or its mav0.
bool is_euroc_layout(const std::vector<std::string>& names);

/// Opens a recording in the layout of EuRoC (ASL) with depth: cam0/data.csv and depth0/data.csv
/// with lines "stamp [ns],file", the images in data/ beside them, the camera in cam0/sensor.yaml,
/// and optional poses of the body in state_groundtruth_estimate0/data.csv (stamp, position,
/// quaternion w x y z, ...). All may be in mav0/.
/// @throws FileError, DataError, ConfigError.
std::unique_ptr<FrameSource> open_euroc(const std::filesystem::path& folder,
                                        const SourceOptions& options);

}  // namespace mms
