#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace mms {

/// Type of a journal record.
enum class RecordType : std::uint8_t { kHeader = 1, kFrame = 2 };

/// First eight bytes of every journal.
inline constexpr std::string_view kJournalMagic = "mmsjrnl\n";

/// A record consists of the payload's length (4 bytes), the type (1), the payload, and the CRC-32
/// (4) of these.
inline constexpr std::size_t kRecordStart = 5;
inline constexpr std::size_t kRecordEnd = 4;
inline constexpr std::size_t kMaxPayload = std::size_t{1} << 30;

/// Encodes a record.
/// @throws DataError if the payload is longer than kMaxPayload.
std::string make_record(RecordType type, std::string_view payload);

}  // namespace mms
