#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/core/motion_samples.hpp"
#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"

namespace mms {

/// One LiDAR scan in the LiDAR frame. The vectors are parallel; optional ones are empty if absent.
/// NaN and infinite points are allowed and count as no return.
struct LidarScan {
  std::vector<Eigen::Vector3f> points;  ///< [m]
  std::vector<float> intensity;         ///< reflectance in the sensor's units
  std::vector<float> time_offset;       ///< relative to the frame's stamp [s]
};

/// Sensor data of one instant: a color image with depth, a LiDAR scan, or both.
struct Frame {
  std::int64_t index = 0;    ///< index in the recording, including skipped frames
  Timestamp stamp;           ///< of the color image, or of the scan if there is none
  std::string name;          ///< name in messages: the file name without folder
  Image<Rgb> color;          ///< may be empty for LiDAR without a camera
  Image<float> depth;        ///< [m], registered to `color`; 0, NaN and inf mean no return
  Duration depth_offset{0};  ///< stamp of `depth` relative to `stamp`
  LidarScan scan;            ///< empty for RGB-D
  /// Label image from the recording: 0 static, else 1 + class id; may be empty.
  Image<std::uint8_t> mask;
  /// Since the previous frame, up to the end of this one; may be empty.
  MotionSamples motion;
  /// Where a user says that the sensor is: its place in the map is searched for around it.
  std::optional<Transform<Global, Sensor>> expected_place;
  std::shared_ptr<const Calibration> calibration;  ///< never null

  /// Whether this is an RGB-D frame.
  bool has_depth() const { return !depth.empty(); }
};

}  // namespace mms
