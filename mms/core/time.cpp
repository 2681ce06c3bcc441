#include "mms/core/time.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace mms {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::size_t kDecimals = 9;
constexpr std::int64_t kMaxSeconds = INT64_MAX / kNanosecondsPerSecond - 1;

std::optional<std::int64_t> parse_digits(std::string_view digits) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = error == std::errc() && end == digits.data() + digits.size();
  if (!whole || digits.front() == '-') return std::nullopt;
  return value;
}

}  // namespace

Timestamp Timestamp::from_seconds(double seconds) {
  return Timestamp(std::llround(seconds * static_cast<double>(kNanosecondsPerSecond)));
}

std::optional<Timestamp> Timestamp::parse(std::string_view text) {
  const std::size_t point = text.find('.');
  const std::string_view whole = text.substr(0, point);
  if (whole.empty()) return std::nullopt;
  const auto seconds = parse_digits(whole);
  if (!seconds || *seconds > kMaxSeconds) return std::nullopt;

  std::string fraction(point == std::string_view::npos ? "" : text.substr(point + 1));
  if (fraction.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
  fraction.resize(kDecimals, '0');
  return Timestamp(*seconds * kNanosecondsPerSecond + *parse_digits(fraction));
}

std::string Timestamp::to_string() const {
  // Unsigned, since -INT64_MIN overflows.
  const auto bits = static_cast<std::uint64_t>(nanoseconds_);
  const std::uint64_t magnitude = nanoseconds_ < 0 ? 0 - bits : bits;
  char text[32];
  std::snprintf(text, sizeof text, "%s%llu.%09llu", nanoseconds_ < 0 ? "-" : "",
                static_cast<unsigned long long>(magnitude / kNanosecondsPerSecond),
                static_cast<unsigned long long>(magnitude % kNanosecondsPerSecond));
  return text;
}

}  // namespace mms
