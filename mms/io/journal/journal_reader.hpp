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

/// Reads a journal record by record, up to the first that is not whole: the end of one whose writer
/// was killed.
class JournalReader {
 public:
  /// @throws FileError when the file cannot be opened; DataError when it is not a journal, of
  /// another
  ///         version, or ends before its header does.
  explicit JournalReader(const std::filesystem::path& path);

  /// What the journal begins with.
  const JournalHeader& header() const { return header_; }

  /// The next frame; nothing at the end or at the first damaged record.
  std::optional<JournalFrame> next();

  /// What is wrong with the record at which `next` stopped; empty when the journal ends whole.
  const std::string& damage() const { return damage_; }

 private:
  std::string take_record(RecordType expected);
  std::string take_bytes(std::size_t size);

  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;  // of the file when it was opened
  std::uint64_t left_ = 0;  // bytes not yet read
  std::uint64_t at_ = 0;    // where the record begins
  JournalHeader header_;
  std::string damage_;
};

}  // namespace mms
