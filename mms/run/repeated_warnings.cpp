#include "mms/run/repeated_warnings.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace mms {
namespace {

constexpr std::size_t kShown = 3;

/// The message with its words that have digits replaced.
std::string kind_of(const std::string& message) {
  std::istringstream words(message);
  std::string kind;
  for (std::string word; words >> word;) {
    const bool varies =
        std::any_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    kind += (varies ? "#" : word) + ' ';
  }
  return kind;
}

}  // namespace

bool RepeatedWarnings::add(const std::string& message) {
  const std::scoped_lock lock(mutex_);
  Kind& kind = kinds_[kind_of(message)];
  if (kind.count == 0) kind.first = message;
  return ++kind.count <= kShown;
}

std::vector<std::string> RepeatedWarnings::rest() const {
  const std::scoped_lock lock(mutex_);
  std::vector<std::string> lines;
  for (const auto& [key, kind] : kinds_) {
    if (kind.count <= kShown) continue;
    lines.push_back(std::to_string(kind.count - kShown) + " more like: " + kind.first);
  }
  return lines;
}

}  // namespace mms
