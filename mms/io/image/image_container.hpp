#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mms {

/// The largest number of pixels of an image: 2^26, or that of the environment variable
/// MMS_MAX_IMAGE_PIXELS. @throws ConfigError if it is no number above 0.
std::uint64_t pixel_limit();

/// Checks that the bytes are an image file: PNG, JPEG, BMP, WebP, TIFF, EXR, PFM or PGM, and except
/// for TIFF and EXR that it is complete. Decoders fill missing parts of truncated files with gray
/// and only print a warning. Refused before memory is allocated are files with more than 16384
/// pixels a side, more than 2^26 pixels, or pixels that need more than 512 MiB; the environment
/// variable MMS_MAX_IMAGE_PIXELS sets the number of pixels, and with it the memory, 8 bytes a
/// pixel.
/// @throws DataError at `where` for such files and other formats.
void check_whole_image(std::string_view bytes, const std::string& where);

}  // namespace mms
