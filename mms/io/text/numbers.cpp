#include "mms/io/text/numbers.hpp"

#include <charconv>
#include <cmath>

namespace mms {
namespace {

template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
  // std::from_chars rejects a plus sign.
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> parse_double(std::string_view text) {
  return parse_whole<double>(text);
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  return parse_whole<std::int64_t>(text);
}

std::optional<Timestamp> stamp_of_number(std::int64_t number) {
  for (const std::int64_t unit : {1, 1'000, 1'000'000}) {  // [ns]
    const std::int64_t first = 1'000'000'000'000'000'000 / unit;
    if (number >= first && number < 9 * first) return Timestamp(number * unit);
  }
  return std::nullopt;
}

std::optional<Timestamp> parse_stamp(std::string_view text) {
  if (const auto exact = Timestamp::parse(text)) return exact;
  if (const auto whole = parse_integer(text)) {
    if (const auto stamp = stamp_of_number(*whole)) return stamp;
  }
  constexpr double kMaxSeconds = 9.2e9;
  constexpr double kMaxWhole = 9e18;  // int64
  const auto seconds = parse_double(text);
  if (!seconds || !(std::abs(*seconds) < kMaxWhole)) return std::nullopt;
  if (std::abs(*seconds) < kMaxSeconds) return Timestamp::from_seconds(*seconds);
  return stamp_of_number(static_cast<std::int64_t>(*seconds));  // "1305031102175.304" [ms]
}

std::string format_number(double value) {
  // By default std::to_chars prefers 1e+05 to 100000.
  const double size = std::abs(value);
  const bool plain = value == 0.0 || (size >= 1e-4 && size < 1e7);
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, value,
                                    plain ? std::chars_format::fixed : std::chars_format::general);
  return {text, result.ptr};
}

}  // namespace mms
