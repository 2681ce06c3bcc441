#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mms {

/// Length of time [ns]; use `to_seconds` for floating-point arithmetic.
using Duration = std::chrono::nanoseconds;

constexpr double to_seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// Instant on the recording's clock: int64 nanoseconds since its epoch. A strong type, so that
/// stamps are not mixed with durations or seconds.
class Timestamp {
 public:
  constexpr Timestamp() = default;  ///< the epoch
  /// @param nanoseconds  since the epoch
  constexpr explicit Timestamp(std::int64_t nanoseconds) : nanoseconds_(nanoseconds) {}

  /// Rounds `seconds` to the nearest nanosecond. For exact conversion from text use `parse`.
  static Timestamp from_seconds(double seconds);

  /// Parses decimal seconds ("1305031102.175304") exactly. Returns nullopt for empty or other text,
  /// overflow and negative numbers.
  static std::optional<Timestamp> parse(std::string_view decimal_seconds);

  constexpr std::int64_t nanoseconds() const { return nanoseconds_; }  ///< since the epoch
  /// Since the epoch [s], rounded to a double.
  constexpr double seconds() const { return static_cast<double>(nanoseconds_) * 1e-9; }

  /// Decimal seconds with nine decimals, as in all output files.
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

constexpr Timestamp operator-(Timestamp stamp, Duration duration) {
  return Timestamp(stamp.nanoseconds() - duration.count());
}

}  // namespace mms
