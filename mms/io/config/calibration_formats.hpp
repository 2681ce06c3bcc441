#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>

#include "mms/core/calibration.hpp"

namespace mms {

/// A calibration, and how its file was read.
struct FormattedCalibration {
  Calibration calibration;  ///< with a camera, except for our own format
  std::string format;       ///< "MMS-SLAM", "ROS or OpenCV", "Kalibr", ...
  /// Pose of the camera in the robot's body frame, as EuRoC's T_BS.
  std::optional<Eigen::Isometry3d> T_body_camera = std::nullopt;
  bool assumed_depth_scale = false;  ///< the file has none; 1000 units per meter
};

/// Reads a calibration file of any known format, recognized by its keys: calibration.yaml
/// (`read_calibration`), the YAML of ROS camera_info and OpenCV, of Kalibr (cam0), of EuRoC's
/// sensor.yaml, OpenLORIS's sensors.yaml and of ORB-SLAM, and the JSON of `read_camera_json`. Of
/// other formats than our own only the first camera is read: a pinhole camera with up to five
/// coefficients of the model plumb_bob (radtan).
/// @throws FileError if the file cannot be read; ConfigError, DataError with the key for missing or
/// wrong values, and for other camera and distortion models.
FormattedCalibration read_any_calibration(const std::filesystem::path& path);

/// @throws ConfigError at `where` for a size, focal length or principal point that no camera has.
void check_camera(const CameraIntrinsics& camera, const std::string& where);

}  // namespace mms
