#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace mms {

/// What a journal's record is.
enum class RecordType : std::uint8_t { kHeader = 1, kFrame = 2 };

/// The eight bytes every journal begins with, before its first record.
inline constexpr std::string_view kJournalMagic = "mmsjrnl\n";

/// A record is its payload's length (4 bytes), its type (1), the payload, and the CRC-32 (4) of all
/// of these.
inline constexpr std::size_t kRecordStart = 5;
inline constexpr std::size_t kRecordEnd = 4;
inline constexpr std::size_t kMaxPayload = std::size_t{1} << 30;

/// Makes a record of a payload. @throws DataError when it is longer than kMaxPayload.
std::string make_record(RecordType type, std::string_view payload);

}  // namespace mms
