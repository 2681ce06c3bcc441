#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names contains scans of a LiDAR.
bool is_lidar_scans_layout(const std::vector<std::string>& names);

/// Opens a recording of a LiDAR: KITTI odometry and raw, nuScenes, MulRan, NCLT, Newer College,
/// HeLiPR, and folders of .bin, .pcd or .ply files (find_scan_layout). Stamps are those of
/// read_scan_stamps, ground truth that of read_scan_truth. Further optional files:
/// calibration.yaml or KITTI's calib.txt, point_times/ (float32 per point, seconds since the
/// scan's stamp), and with a camera in the calibration image_2/ and masks/, named as the scans.
/// @throws FileError, DataError; ConfigError for an invalid calibration.yaml.
std::unique_ptr<FrameSource> open_lidar_scans(const std::filesystem::path& folder,
                                              const SourceOptions& options);

}  // namespace mms
