#pragma once

#include <string>
#include <vector>

namespace mms {

/// A text table with header row.
struct PlainTable {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< as many cells each as columns
  std::string note;                            ///< below the table; may be empty
};

/// HTML section in the style of the report.
std::string html_of(const PlainTable& table);

/// Text with aligned columns, for the terminal.
std::string text_of(const PlainTable& table);

}  // namespace mms
