#pragma once

#include <filesystem>
#include <memory>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Opens a recording of ROS (BagReader): color images with registered depth, or LiDAR clouds with
/// or without color images. Frames are associated as for a TUM recording: one to one within 0.02 s
/// (with clouds 0.05 s) by header stamps. The camera comes from camera_info, or from
/// NAME.calibration.yaml next to NAME.bag. T_camera_lidar comes from /tf_static.
/// @throws FileError, DataError, ConfigError with the fault and the available topics.
std::unique_ptr<FrameSource> open_bag(const std::filesystem::path& path,
                                      const SourceOptions& options);

}  // namespace mms
