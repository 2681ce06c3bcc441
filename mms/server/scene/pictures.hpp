#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/server/scene/scene_data.hpp"

namespace mms {

/// What a frame's sensor gave, small enough to be sent.
struct EncodedPictures {
  std::size_t frame = 0;
  ColoredPoints points;                ///< in the sensor frame, at most kMaxScanPoints
  std::vector<std::uint8_t> dynamic;   ///< parallel to `points`: 1 is dynamic
  std::vector<std::uint8_t> jpeg;      ///< empty without an image
  std::vector<std::uint8_t> mask_png;  ///< empty for a LiDAR
};

inline constexpr std::size_t kMaxScanPoints = 20000;
inline constexpr int kMaxImageWidth = 640;  ///< [px]

/// An image at most `max_width` wide, each pixel the mean of a square of the given ones.
Image<Rgb> shrunk(const Image<Rgb>& image, int max_width);

/// What is dynamic in an organised cloud, a byte a pixel: 0 static, 1 + class id; empty for others.
/// Pixels under a mask that have no depth get the class of the nearest that have.
Image<std::uint8_t> mask_of(const LabeledCloud& cloud);

/// Evenly chosen points of a scan that have a return, at most `max_points`.
/// @param dynamic  set parallel to the result
ColoredPoints scan_points(const LabeledCloud& cloud, std::size_t max_points,
                          std::vector<std::uint8_t>& dynamic);

EncodedPictures encode_pictures(const SensorView& view);

}  // namespace mms
