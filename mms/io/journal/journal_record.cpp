#include "mms/io/journal/journal_record.hpp"

#include "mms/core/error.hpp"
#include "mms/io/journal/byte_reader.hpp"
#include "mms/io/journal/crc32.hpp"

namespace mms {

std::string make_record(RecordType type, std::string_view payload) {
  if (payload.size() > kMaxPayload) {
    throw DataError("journal", "a record has " + std::to_string(payload.size()) +
                                   " bytes, allowed: up to " + std::to_string(kMaxPayload));
  }
  std::string record;
  record.reserve(kRecordStart + payload.size() + kRecordEnd);
  append_bytes(record, static_cast<std::uint32_t>(payload.size()));
  append_bytes(record, type);
  record += payload;
  append_bytes(record, crc32(record));
  return record;
}

}  // namespace mms
