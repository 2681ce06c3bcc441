#pragma once

#include <cstdint>

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

}  // namespace mms
