#include "mms/io/journal/journal_reader.hpp"

#include <cerrno>
#include <cstring>

#include "mms/core/error.hpp"
#include "mms/io/journal/byte_reader.hpp"
#include "mms/io/journal/crc32.hpp"

namespace mms {
namespace fs = std::filesystem;

JournalReader::JournalReader(const fs::path& path) : path_(path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw FileError(path.string(), "no such file");
  if (!fs::is_regular_file(status)) throw FileError(path.string(), "is not a regular file");
  errno = 0;
  stream_.open(path, std::ios::binary);
  left_ = size_ = stream_ ? fs::file_size(path, error) : 0;
  if (!stream_ || error) {
    throw FileError(path.string(), std::string("cannot be read: ") + std::strerror(errno));
  }
  if (left_ == 0) {
    throw DataError(path.string(), "is empty", "the run ended before the header was written");
  }
  if (left_ < kJournalMagic.size() || take_bytes(kJournalMagic.size()) != kJournalMagic) {
    throw DataError(path.string(), "is not a journal of mms run: does not begin with 'mmsjrnl'");
  }
  header_ = decode_header(take_record(RecordType::kHeader), path.string() + ": its header");
}

std::optional<JournalFrame> JournalReader::next() {
  if (left_ == 0 || !damage_.empty()) return std::nullopt;
  try {
    return decode_frame(take_record(RecordType::kFrame),
                        path_.string() + ": the record at byte " + std::to_string(at_));
  } catch (const DataError& error) {
    damage_ = error.what();
    return std::nullopt;
  }
}

std::string JournalReader::take_record(RecordType expected) {
  at_ = size_ - left_;
  const std::string where = path_.string() + ": the record at byte " + std::to_string(at_);
  const std::string torn = "is truncated, probably by a killed run";
  if (left_ < kRecordStart + kRecordEnd) throw DataError(where, torn);
  std::string record = take_bytes(kRecordStart);
  ByteReader start(record, where);
  const auto length = start.take<std::uint32_t>();
  const auto type = start.take<RecordType>();
  if (length > kMaxPayload || length > left_ - kRecordEnd) throw DataError(where, torn);
  record += take_bytes(length);
  const std::string sum = take_bytes(kRecordEnd);
  if (ByteReader(sum, where).take<std::uint32_t>() != crc32(record)) {
    throw DataError(where, "has a wrong checksum");
  }
  if (type != expected) {
    throw DataError(where, "has type " + std::to_string(static_cast<int>(type)) + ", expected " +
                               std::to_string(static_cast<int>(expected)));
  }
  return record.substr(kRecordStart);
}

std::string JournalReader::take_bytes(std::size_t size) {
  std::string bytes(size, '\0');
  stream_.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream_) throw DataError(path_.string(), "was shortened during reading");
  left_ -= size;
  return bytes;
}

}  // namespace mms
