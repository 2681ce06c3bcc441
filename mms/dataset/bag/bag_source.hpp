#pragma once

#include <filesystem>
#include <memory>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Opens a ROS 1 bag: colour images with registered depth, or LiDAR clouds with or without colour
/// images. Frames are made as of a TUM recording: images are matched one to one within 0.02 s (with
/// clouds 0.05 s) by the stamps of their headers. The camera is that of camera_info; a file
/// NAME.calibration.yaml beside NAME.bag takes its place. T_camera_lidar comes from /tf_static.
/// @throws FileError, DataError, ConfigError saying what is wrong and which topics there are.
std::unique_ptr<FrameSource> open_bag(const std::filesystem::path& path,
                                      const SourceOptions& options);

}  // namespace mms
