#include "mms/segmentation/onnx/class_names.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "mms/core/error.hpp"

namespace mms::onnx {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

/// Parses a Python literal from left to right.
class LiteralReader {
 public:
  explicit LiteralReader(std::string_view text) : rest_(trimmed(text)) {}

  bool at_end() {
    rest_ = trimmed(rest_);
    return rest_.empty();
  }

  /// Consumes `sign` if it is next.
  bool take(char sign) {
    if (at_end() || rest_.front() != sign) return false;
    rest_.remove_prefix(1);
    return true;
  }

  /// "12:" before a value.
  std::optional<int> key() {
    int number = 0;
    if (at_end()) return std::nullopt;
    const auto [end, fault] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    if (fault != std::errc()) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return take(':') ? std::optional(number) : std::nullopt;
  }

  /// A string in either kind of quotes; a backslash escapes the next character.
  std::optional<std::string> quoted() {
    if (at_end() || (rest_.front() != '\'' && rest_.front() != '"')) return std::nullopt;
    std::string text;
    for (std::size_t i = 1; i < rest_.size(); ++i) {
      if (rest_[i] == rest_.front()) {
        rest_.remove_prefix(i + 1);
        return text;
      }
      if (rest_[i] == '\\' && i + 1 < rest_.size()) ++i;
      text += rest_[i];
    }
    return std::nullopt;
  }

 private:
  std::string_view rest_;
};

/// The names by number, as far as the text can be parsed.
std::map<int, std::string> numbered_names(LiteralReader& reader, bool dictionary) {
  std::map<int, std::string> names;
  do {
    const auto next = static_cast<int>(names.size());
    const std::optional<int> key = dictionary ? reader.key() : next;
    const std::optional<std::string> name = key ? reader.quoted() : std::nullopt;
    if (!name || !names.emplace(*key, *name).second) return {};
  } while (reader.take(','));
  return names;
}

}  // namespace

std::vector<std::string> listed_names(std::string_view text, const std::string& where) {
  std::vector<std::string> names;
  if (trimmed(text).empty()) return names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    names.emplace_back(trimmed(text.substr(begin, end - begin)));
    if (names.back().empty()) {
      throw DataError(where, "class " + std::to_string(names.size()) + " of '" + std::string(text) +
                                 "' is empty");
    }
    begin = end + 1;
  }
  return names;
}

std::vector<std::string> python_names(std::string_view text) {
  LiteralReader reader(text);
  const bool dictionary = reader.take('{');
  if (!dictionary && !reader.take('[')) return {};
  const std::map<int, std::string> numbered = numbered_names(reader, dictionary);
  if (!reader.take(dictionary ? '}' : ']') || !reader.at_end()) return {};
  std::vector<std::string> names;
  for (const auto& [number, name] : numbered) {
    if (number != static_cast<int>(names.size())) return {};
    names.push_back(name);
  }
  return names;
}

}  // namespace mms::onnx
