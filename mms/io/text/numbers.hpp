#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mms/core/time.hpp"

namespace mms {

/// Parses the whole of `text` as a number, including "nan" and "inf"; nullopt if it is none.
std::optional<double> parse_double(std::string_view text);

/// Parses the whole of `text` as a decimal integer; nullopt if it is none.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// The stamp that a whole number is: nanoseconds, microseconds or milliseconds since 1970, from the
/// year 2001 to 2255; nullopt for other numbers.
std::optional<Timestamp> stamp_of_number(std::int64_t number);

/// Parses a stamp in seconds: exact for plain decimals, with the precision of a double for
/// "1.3e+09" and negative ones. Numbers too large for seconds are those of `stamp_of_number`.
/// nullopt if it does not fit int64 nanoseconds.
std::optional<Timestamp> parse_stamp(std::string_view text);

/// The shortest decimal text that `parse_double` reads back as the same value.
std::string format_number(double value);

}  // namespace mms
