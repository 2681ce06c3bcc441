#pragma once

#include <filesystem>
#include <string_view>

#include "mms/io/journal/journal.hpp"

namespace mms {

/// Writes a journal, which only ever grows. Every record is with the kernel when a call returns:
/// the end of the process, however it comes, loses none; the end of the machine may.
class JournalWriter {
 public:
  /// Begins a journal; an older one of that name is gone.
  /// @throws FileError when the file cannot be written.
  JournalWriter(const std::filesystem::path& path, const JournalHeader& header);
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  /// @throws FileError when the record could not be written whole. It is then torn, and the next
  ///         ones would never be read.
  void append(const JournalFrame& frame);

 private:
  void write(std::string_view bytes);
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace mms
