#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace mms {

/// Escapes text for HTML and SVG elements and quoted attributes; control characters other than tab
/// and newline, and invalid UTF-8, become the replacement character.
std::string escape_html(std::string_view text);

/// Standard base64 with padding (RFC 4648, section 4).
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace mms
