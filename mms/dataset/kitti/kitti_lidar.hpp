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

/// Opens a folder of scans of float32 (*.bin, or in velodyne/), sorted by name, with three to six
/// numbers a point (floats_per_point): KITTI odometry, nuScenes and others. Optional files:
/// times.txt ([s]; default: stamps of nuScenes in the names, else 10 Hz), calibration.yaml or
/// KITTI's calib.txt, poses*.txt or ../../poses/NAME.txt (ground truth of camera 0, transformed to
/// the LiDAR), point_times/ (float32 per point, seconds since the scan's stamp), and with a camera
/// in the calibration image_2/ and masks/, named as the scans.
/// @throws FileError, DataError; ConfigError for an invalid calibration.yaml.
std::unique_ptr<FrameSource> open_kitti_lidar(const std::filesystem::path& folder,
                                              const SourceOptions& options);

}  // namespace mms
