#pragma once

#include <string>
#include <string_view>

#include "mms/core/image.hpp"

namespace mms {

/// Decodes a PNG or JPEG file with stb_image, for builds without OpenCV.
/// @throws DataError at `where` if it is truncated or not an image.
Image<Rgb> decode_with_stb(std::string_view bytes, const std::string& where);

}  // namespace mms
