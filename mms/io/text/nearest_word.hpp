#pragma once

#include <span>
#include <string>
#include <string_view>

namespace mms {

/// Levenshtein distance of `a` and `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Hint for an unknown `word`: "did you mean 'x'?" if one of `known` is close, else the list of
/// all.
std::string suggestion(std::string_view word, std::span<const std::string> known);

}  // namespace mms
