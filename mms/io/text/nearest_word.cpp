#include "mms/io/text/nearest_word.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace mms {
namespace {

std::string joined(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// Levenshtein distance of `a` and `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::optional<std::string> nearest_word(std::string_view word, std::span<const std::string> known) {
  if (known.empty()) return std::nullopt;
  const auto nearest =
      std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
        return edit_distance(word, a) < edit_distance(word, b);
      });
  const std::size_t allowed = std::max<std::size_t>(2, nearest->size() / 3);
  const std::size_t distance = edit_distance(word, *nearest);
  if (distance <= allowed && distance < nearest->size()) return *nearest;
  return std::nullopt;
}

std::string suggestion(std::string_view word, std::span<const std::string> known) {
  if (known.empty()) return "";
  const auto nearest = nearest_word(word, known);
  if (nearest) return "did you mean '" + *nearest + "'?";
  constexpr std::size_t kMaxListed = 40;
  constexpr std::size_t kNearest = 3;
  if (known.size() <= kMaxListed) return "known: " + joined(known);
  std::vector<std::string> sorted(known.begin(), known.end());
  std::stable_sort(sorted.begin(), sorted.end(), [&](const std::string& a, const std::string& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
  return "the nearest of " + std::to_string(known.size()) + ": " +
         joined(std::span(sorted).first(kNearest));
}

}  // namespace mms
