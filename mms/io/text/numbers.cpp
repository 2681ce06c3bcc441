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

std::optional<Timestamp> parse_stamp(std::string_view text) {
  if (const auto exact = Timestamp::parse(text)) return exact;
  constexpr double kMaxSeconds = 9.2e9;
  const auto seconds = parse_double(text);
  if (!seconds || !(std::abs(*seconds) < kMaxSeconds)) return std::nullopt;
  return Timestamp::from_seconds(*seconds);
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
