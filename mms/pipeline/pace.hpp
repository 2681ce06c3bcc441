#pragma once

#include <chrono>
#include <optional>
#include <thread>

#include "mms/core/time.hpp"

namespace mms {

/// Real-time playback: frames are released with the intervals of their stamps.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  /// Lets time pass until a frame would have come from the sensor, and returns that time. A frame
  /// that was read later than that is as old already.
  Clock::time_point wait_for(Timestamp stamp) {
    if (!first_) {
      first_ = stamp;
      start_ = Clock::now();
    }
    const Clock::time_point due = start_ + (stamp - *first_);
    std::this_thread::sleep_until(due);
    return due;
  }

 private:
  std::optional<Timestamp> first_;
  Clock::time_point start_;
};

}  // namespace mms
