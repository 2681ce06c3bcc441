#pragma once

#include <cstdint>

#include "mms/core/time.hpp"

namespace mms {

/// Images a second of recordings without stamps.
inline constexpr std::int64_t kAssumedRate = 30;

/// Stamp of an image of such a recording, from number 0 on.
constexpr Timestamp assumed_stamp(std::int64_t number) {
  return Timestamp(number * 1'000'000'000 / kAssumedRate);
}

}  // namespace mms
