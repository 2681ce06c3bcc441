#pragma once

#include <string>
#include <string_view>

namespace mms {

/// Checks that bytes are one whole PNG or JPEG file. Decoders fill what is missing of a truncated
/// one with grey and only print a warning.
/// @throws DataError at `where` for truncated files and for any other format.
void check_whole_image(std::string_view bytes, const std::string& where);

}  // namespace mms
