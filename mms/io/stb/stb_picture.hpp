#pragma once

#include <string>
#include <string_view>

#include "mms/core/image.hpp"

namespace mms {

/// The picture in the bytes of a PNG or JPEG file, by stb_image: for machines without OpenCV.
/// @throws DataError at `where` when they are truncated or no image.
Image<Rgb> decode_with_stb(std::string_view bytes, const std::string& where);

}  // namespace mms
