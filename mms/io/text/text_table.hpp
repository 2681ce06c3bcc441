#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mms {

/// One line of a text table, split at blanks, tabs and commas.
struct TextLine {
  int number = 0;                        ///< line number in the file, from 1
  std::vector<std::string_view> fields;  ///< views into the table
};

/// The lines of a text file that are neither empty nor '#' comments. Owns the text of the fields.
class TextTable {
 public:
  /// @throws FileError if the file cannot be read.
  explicit TextTable(const std::filesystem::path& path);
  TextTable(const TextTable&) = delete;
  TextTable& operator=(const TextTable&) = delete;

  /// In the order of the file.
  const std::vector<TextLine>& lines() const { return lines_; }

  /// Names of the columns: the fields of a first line that is a comment, without '#'; else none.
  const std::vector<std::string_view>& header() const { return header_; }

  /// Those of all lines.
  std::vector<std::string_view> fields() const;

  /// "file:12", for messages.
  std::string where(const TextLine& line) const;

 private:
  std::string file_;
  std::string text_;
  std::vector<std::string_view> header_;
  std::vector<TextLine> lines_;
};

}  // namespace mms
