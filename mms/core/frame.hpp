#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/core/time.hpp"

namespace mms {

/// One LiDAR scan in the LiDAR frame; the vectors are parallel, optional ones empty when absent.
/// Points that are NaN or infinite are ordinary input and count as no return.
struct LidarScan {
  std::vector<Eigen::Vector3f> points;  ///< [m]
  std::vector<float> intensity;         ///< reflectance as the sensor gave it
  std::vector<float> time_offset;       ///< since the frame's stamp [s]
};

/// What the sensor gave at one instant: an image with depth, a LiDAR scan, or both.
struct Frame {
  std::int64_t index = 0;    ///< position in the recording, skipped frames counted
  Timestamp stamp;           ///< of the colour image, or of the scan where there is none
  std::string name;          ///< what messages call it: the file name without folder
  Image<Rgb> color;          ///< may be empty for LiDAR without a camera
  Image<float> depth;        ///< [m], registered to `color`; 0, NaN and inf mean no return
  Duration depth_offset{0};  ///< when `depth` was taken, relative to `stamp`
  LidarScan scan;            ///< empty for RGB-D
  Image<std::uint8_t> mask;  ///< given label image: 0 static, else 1 + class id; may be empty
  std::shared_ptr<const Calibration> calibration;  ///< never null

  bool has_depth() const { return !depth.empty(); }
};

}  // namespace mms
