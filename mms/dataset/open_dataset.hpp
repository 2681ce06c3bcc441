#pragma once

#include <filesystem>
#include <memory>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Opens a recording. The layout of a folder is detected (tum_rgbd, numbered/, folder_rgbd,
/// video_rgbd, lidar_scans, rosbag2), x.bag, x.mcap and x.db3 are recordings of ROS (bag_source),
/// x.pcap is a capture of LiDAR packets (capture_source), x.oni a recording of OpenNI (oni_source),
/// and an address such as "sim:crowd" is a simulation (simulated_source).
/// @throws DataError with the found and expected files if there is no or an incomplete recording;
/// FileError and ConfigError for invalid files.
std::unique_ptr<FrameSource> open_dataset(const std::filesystem::path& path,
                                          const SourceOptions& options = {});

}  // namespace mms
