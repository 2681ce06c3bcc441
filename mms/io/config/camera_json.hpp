#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <string>

#include "mms/core/calibration.hpp"

namespace mms {

/// Reads a camera without distortion from a JSON file: that of Open3D (`width`, `height`,
/// `intrinsic_matrix` of nine numbers, column by column) with an optional `depth_scale` as its
/// recorders write it, or that of NICE-SLAM (`camera` with `w`, `h`, `fx`, `fy`, `cx`, `cy`,
/// `scale`).
/// @returns depth_scale is 1000 units per meter where the file has none
/// @throws FileError if the file cannot be read; DataError with the key for other content.
Calibration read_camera_json(const std::filesystem::path& path);

/// A camera with its pose.
struct PosedCamera {
  Eigen::Matrix3d matrix;            ///< [px]
  Eigen::Isometry3d T_world_camera;  ///< translation in the unit of the file [m]
};

/// Reads ScanNet++'s pose_intrinsic_imu.json: an object with an entry for each frame, as
/// "frame_000010", with `intrinsic` (3x3) and `aligned_pose` or `pose` (4x4, camera-to-world).
/// @throws FileError if the file cannot be read; DataError with the key for other content.
std::map<std::string, PosedCamera> read_posed_cameras(const std::filesystem::path& path);

}  // namespace mms
