#pragma once

#include <span>
#include <string>
#include <string_view>

namespace mms {

/// Number of letters to insert, drop or change to make `b` of `a` (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// What to tell someone who wrote `word` where one of `known` is wanted: "did you mean 'x'?" when
/// one is near, else the list of all.
std::string suggestion(std::string_view word, std::span<const std::string> known);

}  // namespace mms
