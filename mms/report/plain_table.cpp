#include "mms/report/plain_table.hpp"

#include <algorithm>

#include "mms/report/html.hpp"

namespace mms {
namespace {

std::string row_html(const std::vector<std::string>& cells, const std::string& element) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) {
    row += "<" + element + ">" + escape_html(cell) + "</" + element + ">";
  }
  return row + "</tr>";
}

std::vector<std::size_t> widths(const PlainTable& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(column.size());
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  return widths;
}

/// The first column left-aligned, the others right-aligned.
std::string row_text(const std::vector<std::string>& cells,
                     const std::vector<std::size_t>& widths) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string padding(widths[i] - cells[i].size(), ' ');
    line += i == 0 ? cells[i] + padding : "  " + padding + cells[i];
  }
  return line + "\n";
}

}  // namespace

std::string html_of(const PlainTable& table) {
  std::string html = "<section><h2>" + escape_html(table.title) + "</h2><table class=\"plain\">" +
                     "<thead>" + row_html(table.columns, "th") + "</thead><tbody>";
  for (const auto& row : table.rows) html += row_html(row, "td");
  html += "</tbody></table>";
  if (!table.note.empty()) html += "<p class=\"note\">" + escape_html(table.note) + "</p>";
  return html + "</section>\n";
}

std::string text_of(const PlainTable& table) {
  const std::vector<std::size_t> columns = widths(table);
  std::string text = table.title + "\n" + row_text(table.columns, columns);
  for (const auto& row : table.rows) text += row_text(row, columns);
  if (!table.note.empty()) text += table.note + "\n";
  return text;
}

}  // namespace mms
