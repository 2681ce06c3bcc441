#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mms/core/time.hpp"

namespace mms {

/// The number that the whole of `text` spells, "nan" and "inf" included; nothing otherwise.
std::optional<double> parse_double(std::string_view text);

/// The whole number that the whole of `text` spells in decimal; nothing otherwise.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// A stamp in seconds: exact for plain decimals, to a double's precision for "1.3e+09" and
/// negative ones; nothing for anything that fits no int64 of nanoseconds.
std::optional<Timestamp> parse_stamp(std::string_view text);

/// The shortest decimal text that `parse_double` reads back as the same value.
std::string format_number(double value);

}  // namespace mms
