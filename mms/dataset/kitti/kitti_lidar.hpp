#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names contains KITTI scans.
bool is_kitti_lidar_layout(const std::vector<std::string>& names);

/// Opens a folder of KITTI scans (*.bin, or in velodyne/), sorted by name. Optional files:
/// times.txt ([s], default 10 Hz), poses*.txt (ground truth of camera 0, transformed to the LiDAR
/// with T_camera_lidar of calibration.yaml), point_times/ (float32 per point, seconds since the
/// scan's stamp), and with a camera in calibration.yaml image_2/ and masks/, named as the scans.
/// @throws FileError, DataError; ConfigError for an invalid calibration.yaml.
std::unique_ptr<FrameSource> open_kitti_lidar(const std::filesystem::path& folder,
                                              const SourceOptions& options);

}  // namespace mms
