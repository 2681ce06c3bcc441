#pragma once

#include <cstdint>
#include <optional>

#include "mms/core/time.hpp"

namespace mms {

/// Images a second of recordings without stamps.
inline constexpr std::int64_t kAssumedRate = 30;

/// The largest number of an image without stamp; a year of images.
inline constexpr std::int64_t kMaxImageNumber = 1'000'000'000;

/// Stamp of an image without one, from number 0 to kMaxImageNumber.
constexpr Timestamp assumed_stamp(std::int64_t number) {
  return Timestamp(number * 1'000'000'000 / kAssumedRate);
}

/// The stamp that a number in a file's name is: nanoseconds, microseconds or milliseconds since
/// 1970, from the year 2001 to 2255; nullopt for other numbers.
constexpr std::optional<Timestamp> stamp_of_number(std::int64_t number) {
  for (const std::int64_t unit : {1, 1'000, 1'000'000}) {  // [ns]
    const std::int64_t first = 1'000'000'000'000'000'000 / unit;
    if (number >= first && number < 9 * first) return Timestamp(number * unit);
  }
  return std::nullopt;
}

}  // namespace mms
