#pragma once

#include <cstdint>
#include <string_view>

namespace mms {

/// CRC-32 of ISO 3309, as in PNG, zip and Ethernet.
std::uint32_t crc32(std::string_view bytes);

}  // namespace mms
