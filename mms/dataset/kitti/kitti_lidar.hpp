#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these names in it holds KITTI scans.
bool is_kitti_lidar_layout(const std::vector<std::string>& names);

/// Opens a folder of KITTI scans (*.bin, or in velodyne/), in the order of their names. Optional in
/// the folder: times.txt ([s], else 10 Hz), poses*.txt (truth of camera 0, taken
/// to the scanner by calibration.yaml's T_camera_lidar), point_times/ (float32 a point, seconds
/// since the scan's stamp), and with a camera in calibration.yaml image_2/ and masks/, all files
/// named like the scans.
/// @throws FileError, DataError; ConfigError for a faulty calibration.yaml.
std::unique_ptr<FrameSource> open_kitti_lidar(const std::filesystem::path& folder,
                                              const SourceOptions& options);

}  // namespace mms
