#pragma once

// Internal to io.

#include <opencv2/core/mat.hpp>
#include <string_view>

namespace mms {

/// Decodes a PNG file with libpng, since OpenCV lets libpng print its messages on stderr.
/// @param color  converts to 8-bit blue, green, red; else as stored, with palettes as color
/// @returns an empty matrix for a damaged file
cv::Mat decode_png(std::string_view bytes, bool color);

}  // namespace mms
