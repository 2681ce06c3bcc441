#pragma once

#include <string>
#include <string_view>

namespace mms {

/// Checks that the bytes are a complete PNG or JPEG file. Decoders fill missing parts of a
/// truncated file with gray and only print a warning.
/// @throws DataError at `where` for truncated files and other formats.
void check_whole_image(std::string_view bytes, const std::string& where);

}  // namespace mms
