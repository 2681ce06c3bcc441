#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names is an exported scan of ScanNet.
bool is_scannet_layout(const std::vector<std::string>& names);

/// Opens a scan of ScanNet as its SensReader exports it: color/N.jpg, depth/N.png [mm],
/// intrinsic/intrinsic_color.txt and intrinsic_depth.txt (4x4), optional pose/N.txt (4x4,
/// camera-to-world, infinite where unknown). Frames have the depth images' size; their colors are
/// sampled, for both cameras of ScanNet count as one place.
/// @throws FileError, DataError.
std::unique_ptr<FrameSource> open_scannet(const std::filesystem::path& folder,
                                          const SourceOptions& options);

}  // namespace mms
