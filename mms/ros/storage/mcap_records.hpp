#pragma once

#include <cstdint>
#include <string_view>

namespace mms {

// Records of MCAP files (mcap.dev/spec): kind, 64-bit length, content. All numbers are
// little-endian; strings and lists are preceded by their 32-bit length in bytes.

inline constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);

/// Kinds of records.
enum class McapOp : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// Kind and length of a record [B].
inline constexpr std::size_t kMcapHead = sizeof(McapOp) + sizeof(std::uint64_t);

}  // namespace mms
