#pragma once

// Internal to io: the text headers that PLY and PCD files begin with.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mms {

/// Reads a header line by line off the front of a file's bytes.
class HeaderText {
 public:
  /// @param bytes  of the file, from its start; have to outlive the reader
  /// @param file   for messages
  HeaderText(std::string_view bytes, std::string file) : rest_(bytes), file_(std::move(file)) {}

  /// Words of the next line that is no comment. @throws DataError when there is no further line,
  /// or when what should be a line is longer than any header's.
  std::vector<std::string> next_line();

  /// Bytes after the lines taken so far.
  std::string_view rest() const { return rest_; }

  /// "file:12" of the line taken last, for messages.
  std::string where() const { return file_ + ":" + std::to_string(line_); }

  /// @throws DataError at the current line, with that text.
  [[noreturn]] void fail(const std::string& what, const std::string& hint = "") const;

  /// The count that `word` spells. @throws DataError when it is none.
  std::uint64_t count(const std::string& word) const;

 private:
  std::string_view rest_;
  std::string file_;
  int line_ = 0;
};

}  // namespace mms
