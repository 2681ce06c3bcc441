#pragma once

#include <cstdint>
#include <span>

#include "mms/core/image.hpp"

namespace mms {

/// Size and layout of a raw image.
struct RawImageLayout {
  int width = 0;          ///< [px]
  int height = 0;         ///< [px]
  std::size_t pitch = 0;  ///< from one row to the next [bytes]
};

/// Whether `bytes` has all rows of an image with two bytes a pixel.
bool holds_image(std::span<const std::uint8_t> bytes, const RawImageLayout& layout);

/// Colors of an image in YUYV (YCbCr 4:2:2 of ITU-R BT.601, limited range).
/// @param bytes  of which `holds_image` is true; the width is even
Image<Rgb> color_from_yuyv(std::span<const std::uint8_t> bytes, const RawImageLayout& layout);

/// Depth [m] of an image in Z16: 16 bits, little endian; 0 for no return.
/// @param bytes  of which `holds_image` is true
/// @param scale  depth units per meter
Image<float> depth_from_z16(std::span<const std::uint8_t> bytes, const RawImageLayout& layout,
                            double scale);

}  // namespace mms
