#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/dataset/lidar/scan_layout.hpp"

namespace mms {

/// Ground truth of the LiDAR; empty if there is none. Adds a fact.
/// KITTI: poses*.txt or ../../poses/NAME.txt, of the camera, or in TUM's format of the LiDAR.
/// KITTI raw: oxts/ with ../calib_imu_to_velo.txt. MulRan: global_pose.csv.
/// NCLT: ../ground_truth/groundtruth_NAME.csv. Newer College: ground_truth/registered_poses.csv.
/// HeLiPR: ../../LiDAR_GT/global_NAME_gt.txt.
/// All: groundtruth.txt (TUM) with poses of the LiDAR.
/// @param stamps          of the scans
/// @param T_camera_lidar  of the poses' camera of KITTI
/// @throws FileError if a file cannot be read; DataError for a damaged line.
Trajectory read_scan_truth(const std::filesystem::path& folder, const ScanLayout& layout,
                           std::span<const Timestamp> stamps,
                           const Eigen::Isometry3d& T_camera_lidar,
                           std::vector<std::string>& facts);

}  // namespace mms
