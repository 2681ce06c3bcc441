#pragma once

#include <cstdint>

#include "mms/core/time.hpp"

namespace mms {

/// Frames a second of a recording without stamps.
struct AssumedRate {
  int hz;         ///< [Hz]
  bool is_known;  ///< of the data set or kind of sensor; else it is a guess
};

/// Of the cameras of known data sets.
inline constexpr AssumedRate kDataSetRate{30, true};

/// Where nothing is known. The odometry works with a rate that is wrong by a factor of two, and
/// 7.5 to 30 Hz are usual.
inline constexpr AssumedRate kUnknownRate{15, false};

/// Of LiDAR sensors, as those of KITTI.
inline constexpr AssumedRate kScanRate{10, true};

/// The largest number of an image without stamp; a year of images.
inline constexpr std::int64_t kMaxImageNumber = 1'000'000'000;

/// Stamp of an image without one, from number 0 to kMaxImageNumber.
constexpr Timestamp assumed_stamp(std::int64_t number, const AssumedRate& rate) {
  return Timestamp(number * 1'000'000'000 / rate.hz);
}

}  // namespace mms
