#pragma once

#include <filesystem>
#include <memory>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Opens a recording; what is in the folder decides on the layout (tum_rgbd, folder_rgbd,
/// kitti_lidar), a file x.bag is a ROS 1 bag (bag_source), and an address like "sim:crowd" opens a
/// simulation (simulated_source).
/// @throws DataError saying what was found and what is wanted when there is no recording or an
///         incomplete one; FileError and ConfigError for files that are there but faulty.
std::unique_ptr<FrameSource> open_dataset(const std::filesystem::path& path,
                                          const SourceOptions& options = {});

}  // namespace mms
