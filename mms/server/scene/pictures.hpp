#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/server/scene/scene_data.hpp"

namespace mms {

/// Sensor data of a frame, encoded for the network.
struct EncodedPictures {
  std::size_t frame = 0;
  ColoredPoints points;                ///< in the sensor frame, at most kMaxScanPoints
  std::vector<std::uint8_t> dynamic;   ///< parallel to `points`: 1 is dynamic
  std::vector<std::uint8_t> jpeg;      ///< empty without an image
  std::vector<std::uint8_t> mask_png;  ///< empty for a LiDAR
};

inline constexpr std::size_t kMaxScanPoints = 20000;
inline constexpr int kMaxImageWidth = 640;  ///< [px]

/// Image downsampled to at most `max_width` by averaging blocks.
Image<Rgb> shrunk(const Image<Rgb>& image, int max_width);

inline constexpr std::uint8_t kOverruledMask = 255;  ///< value of overruled points in `mask_of`

/// Dynamic pixels of an organized cloud, one byte per pixel: 0 static, 1 + class id, or
/// `kOverruledMask`; empty for others. Mask pixels without depth get the class of the nearest pixel
/// with depth.
Image<std::uint8_t> mask_of(const LabeledCloud& cloud);

/// Evenly selected valid points of a scan, at most `max_points`.
/// @param dynamic  set parallel to the result
ColoredPoints scan_points(const LabeledCloud& cloud, std::size_t max_points,
                          std::vector<std::uint8_t>& dynamic);

EncodedPictures encode_pictures(const SensorView& view);

}  // namespace mms
