#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// A binary mask as COCO keeps it: lengths of runs down the columns, from the left column to the
/// right one. The first run is background, perhaps of length 0; then they take turns.
struct Rle {
  int width = 0;                      ///< of the image [px]
  int height = 0;                     ///< of the image [px]
  std::vector<std::uint32_t> counts;  ///< [px], with the sum width * height

  bool operator==(const Rle&) const = default;
};

/// Runs of the pixels that are not zero.
Rle encode_rle(const Image<std::uint8_t>& mask);

/// Runs of the pixels that have just this value.
Rle encode_rle(const Image<std::uint8_t>& labels, std::uint8_t value);

/// Runs of a mask that was cut out of an image of width x height with its corner at (x, y).
/// @throws DataError when it reaches out of the image.
Rle encode_rle(const Image<std::uint8_t>& cut, int x, int y, int width, int height);

/// Image with 1 on the mask and 0 elsewhere.
/// @throws DataError when the runs do not sum up to width * height.
Image<std::uint8_t> decode_rle(const Rle& rle);

/// Number of pixels of the mask.
std::uint64_t rle_area(const Rle& rle);

/// x, y, width, height of the tight box [px]; all zero for an empty mask.
std::array<double, 4> rle_box(const Rle& rle);

/// The compressed form of the counts, printable ASCII, as in pycocotools.
std::string rle_to_string(const Rle& rle);

/// Reads the compressed form.
/// @throws DataError for letters that it does not have, a cut-off text, or runs that do not sum up
///         to width * height.
Rle rle_from_string(std::string_view text, int width, int height);

/// @throws DataError when the runs do not sum up to width * height.
void check_rle(const Rle& rle);

}  // namespace mms
