#pragma once

#include <filesystem>

#include "mms/core/calibration.hpp"

namespace mms {

/// Calibration of a KITTI odometry sequence.
struct KittiCalibration {
  Calibration calibration;  ///< of color camera 2, with a camera if its images are there
  Eigen::Isometry3d T_camera0_lidar = Eigen::Isometry3d::Identity();  ///< of the poses' camera
};

/// Reads calib.txt of the KITTI odometry benchmark: P2 (3x4 projection matrix of camera 2 in the
/// frame of camera 0) and Tr (3x4, LiDAR to camera 0).
/// @param image  an image of camera 2, which has its size; empty for none
/// @throws FileError if a file cannot be read; DataError if a matrix is missing or invalid.
KittiCalibration read_kitti_calibration(const std::filesystem::path& file,
                                        const std::filesystem::path& image);

}  // namespace mms
