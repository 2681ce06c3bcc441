#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mms {

/// Length of time [ns]; `to_seconds` is for arithmetic that leaves integers behind.
using Duration = std::chrono::nanoseconds;

constexpr double to_seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// Instant on the recording's own clock, int64 nanoseconds since that clock's epoch.
/// A strong type: a stamp is neither a duration nor a number of seconds.
class Timestamp {
 public:
  constexpr Timestamp() = default;
  constexpr explicit Timestamp(std::int64_t nanoseconds) : nanoseconds_(nanoseconds) {}

  /// Nearest nanosecond to `seconds`; exact parsing of text is `parse`.
  static Timestamp from_seconds(double seconds);

  /// Reads decimal seconds ("1305031102.175304") without going through floating point.
  /// Returns nothing for anything else (empty, letters, overflow, negative).
  static std::optional<Timestamp> parse(std::string_view decimal_seconds);

  constexpr std::int64_t nanoseconds() const { return nanoseconds_; }
  constexpr double seconds() const { return static_cast<double>(nanoseconds_) * 1e-9; }

  /// Decimal seconds with nine decimals, the form every output file uses.
  std::string to_string() const;

  constexpr auto operator<=>(const Timestamp&) const = default;

 private:
  std::int64_t nanoseconds_ = 0;
};

constexpr Duration operator-(Timestamp later, Timestamp earlier) {
  return Duration(later.nanoseconds() - earlier.nanoseconds());
}

constexpr Timestamp operator+(Timestamp stamp, Duration duration) {
  return Timestamp(stamp.nanoseconds() + duration.count());
}

}  // namespace mms
