#pragma once

// Internal to io: the text headers of PLY and PCD files.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mms {

/// Reads header lines from the front of a file's bytes.
class HeaderText {
 public:
  /// @param bytes  of the file, from its start; have to outlive the reader
  /// @param file   for messages
  HeaderText(std::string_view bytes, std::string file) : rest_(bytes), file_(std::move(file)) {}

  /// Words of the next line that is not a comment.
  /// @throws DataError if there is no further line or the line is too long.
  std::vector<std::string> next_line();

  /// Bytes after the lines read so far.
  std::string_view rest() const { return rest_; }

  /// "file:12" of the last line, for messages.
  std::string where() const { return file_ + ":" + std::to_string(line_); }

  /// @throws DataError at the current line.
  [[noreturn]] void fail(const std::string& what, const std::string& hint = "") const;

  /// Parses a count.
  /// @throws DataError if it is none.
  std::uint64_t count(const std::string& word) const;

 private:
  std::string_view rest_;
  std::string file_;
  int line_ = 0;
};

}  // namespace mms
