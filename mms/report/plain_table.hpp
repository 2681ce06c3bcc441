#pragma once

#include <string>
#include <vector>

namespace mms {

/// A table of text: the columns' headings and the rows.
struct PlainTable {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< as many cells each as there are columns
  std::string note;                            ///< below it; may be empty
};

/// As an HTML section in the style of the report.
std::string html_of(const PlainTable& table);

/// With aligned columns, for the terminal.
std::string text_of(const PlainTable& table);

}  // namespace mms
