#pragma once

#include <string>
#include <string_view>

namespace mms {

/// Checks that the bytes are an image file: PNG, JPEG, BMP, WebP, TIFF, EXR or PFM, and except for
/// TIFF and EXR that it is complete. Decoders fill missing parts of truncated files with gray
/// and only print a warning. Files other than WebP and EXR with
/// more than 16384 pixels a side are refused before memory is allocated.
/// @throws DataError at `where` for such files and other formats.
void check_whole_image(std::string_view bytes, const std::string& where);

}  // namespace mms
