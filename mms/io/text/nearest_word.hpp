#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mms {

/// The word of `known` that is close to `word`; nullopt if none is.
std::optional<std::string> nearest_word(std::string_view word, std::span<const std::string> known);

/// Hint for an unknown `word`: "did you mean 'x'?" if one of `known` is close, else the list of
/// all, of more than 40 the nearest three.
std::string suggestion(std::string_view word, std::span<const std::string> known);

}  // namespace mms
