#include "mms/io/text/header_text.hpp"

#include <sstream>

#include "mms/core/error.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {

std::vector<std::string> HeaderText::next_line() {
  constexpr std::size_t kMaxLine = 4096;
  constexpr int kMaxLines = 1000;
  for (;;) {
    const std::size_t end = rest_.substr(0, kMaxLine).find('\n');
    if (end == std::string_view::npos || line_ >= kMaxLines) fail("the header does not end");
    std::istringstream line{std::string(rest_.substr(0, end))};
    rest_.remove_prefix(end + 1);
    ++line_;
    std::vector<std::string> words;
    for (std::string word; line >> word;) words.push_back(word);
    const bool comment = words.empty() || words[0] == "comment" || words[0] == "obj_info" ||
                         words[0].starts_with('#');
    if (!comment) return words;
  }
}

void HeaderText::fail(const std::string& what, const std::string& hint) const {
  throw DataError(where(), what, hint);
}

std::uint64_t HeaderText::count(const std::string& word) const {
  const auto value = parse_integer(word);
  if (!value || *value < 0) fail("'" + word + "' is not a count");
  return static_cast<std::uint64_t>(*value);
}

}  // namespace mms
