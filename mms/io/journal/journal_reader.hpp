#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "mms/io/journal/journal.hpp"
#include "mms/io/journal/journal_record.hpp"

namespace mms {

/// Reads a journal record by record, up to the first incomplete one, which a killed run may leave.
class JournalReader {
 public:
  /// @throws FileError if the file cannot be opened; DataError if it is not a journal, has another
  /// version, or ends before its header.
  explicit JournalReader(const std::filesystem::path& path);

  /// What the journal begins with.
  const JournalHeader& header() const { return header_; }

  /// The next frame; nullopt at the end or at the first damaged record.
  std::optional<JournalFrame> next();

  /// Fault of the record at which `next` stopped; empty if the journal is complete.
  const std::string& damage() const { return damage_; }

 private:
  std::string take_record(RecordType expected);
  std::string take_bytes(std::size_t size);

  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;  // of the file when it was opened
  std::uint64_t left_ = 0;  // unread bytes
  std::uint64_t at_ = 0;    // offset of the record
  JournalHeader header_;
  std::string damage_;
};

}  // namespace mms
