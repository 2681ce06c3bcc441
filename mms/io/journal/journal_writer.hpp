#pragma once

#include <filesystem>
#include <string_view>

#include "mms/io/journal/journal.hpp"

namespace mms {

/// Appends to a journal. Every record is passed to the kernel before `append` returns: a crash of
/// the process loses none, a crash of the machine may.
class JournalWriter {
 public:
  /// Creates a journal; replaces an existing file.
  /// @throws FileError if the file cannot be written.
  JournalWriter(const std::filesystem::path& path, const JournalHeader& header);
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  /// @throws FileError if the record could not be written completely; the journal cannot be used
  /// further.
  void append(const JournalFrame& frame);

  /// Removes the file, unless its path leads to another file by now.
  void remove() noexcept;

 private:
  void write(std::string_view bytes);
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace mms
