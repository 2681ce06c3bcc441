#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// A binary mask in COCO's encoding: lengths of alternating runs of background and mask in
/// column-major order, beginning with background (possibly of length 0).
struct Rle {
  int width = 0;                      ///< of the image [px]
  int height = 0;                     ///< of the image [px]
  std::vector<std::uint32_t> counts;  ///< [px], with the sum width * height

  bool operator==(const Rle&) const = default;
};

/// Encodes the pixels that are not zero.
Rle encode_rle(const Image<std::uint8_t>& mask);

/// Encodes the pixels equal to `value`.
Rle encode_rle(const Image<std::uint8_t>& labels, std::uint8_t value);

/// Encodes a mask cropped from an image of width x height at (x, y).
/// @throws DataError if it exceeds the image.
Rle encode_rle(const Image<std::uint8_t>& cut, int x, int y, int width, int height);

/// Image with 1 on the mask and 0 elsewhere.
/// @throws DataError if the runs do not sum up to width * height.
Image<std::uint8_t> decode_rle(const Rle& rle);

/// Number of pixels of the mask.
std::uint64_t rle_area(const Rle& rle);

/// x, y, width, height of the bounding box [px]; all zero for an empty mask.
std::array<double, 4> rle_box(const Rle& rle);

/// The counts in compressed form, printable ASCII, as in pycocotools.
std::string rle_to_string(const Rle& rle);

/// Parses the compressed form.
/// @throws DataError for invalid characters, a truncated text, or runs that do not sum up to width
/// * height.
Rle rle_from_string(std::string_view text, int width, int height);

/// @throws DataError if the runs do not sum up to width * height.
void check_rle(const Rle& rle);

}  // namespace mms
