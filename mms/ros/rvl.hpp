#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "mms/core/image.hpp"

namespace mms {

/// Decodes a depth image compressed by RVL (Wilson, Fast Lossless Depth Image Compression, 2017),
/// after its width and height of 32 bits each, as compressed_depth_image_transport writes it.
/// @throws DataError at `where` if it is damaged or larger than 16 megapixels.
Image<std::uint16_t> decode_rvl(std::span<const std::uint8_t> bytes, const std::string& where);

}  // namespace mms
