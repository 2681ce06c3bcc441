#pragma once

#include <chrono>
#include <optional>
#include <thread>

#include "mms/core/time.hpp"

namespace mms {

/// Real-time playback: frames are released with the intervals of their stamps, but for long pauses,
/// which are shortened.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  /// [s]: longest pause. Source: all steps are idle by then, so that a longer one changes no
  /// result; a clock that jumps by a year would stop the run, and Ctrl-C waits for the next frame.
  static constexpr std::chrono::seconds kMaxPause{10};

  /// Lets time pass until a frame would have come from the sensor, and returns that time. A frame
  /// that was read later than that is as old already.
  Clock::time_point wait_for(Timestamp stamp) {
    const Clock::time_point due = due_at(stamp, Clock::now());
    std::this_thread::sleep_until(due);
    return due;
  }

  /// When a frame comes.
  /// @param now  when it was read
  Clock::time_point due_at(Timestamp stamp, Clock::time_point now) {
    if (!first_) {
      first_ = stamp;
      start_ = now;
    }
    const Clock::time_point due = start_ + (stamp - *first_);
    const Clock::time_point latest = now + kMaxPause;
    if (due <= latest) return due;
    start_ -= due - latest;  // those that follow come earlier, too
    return latest;
  }

 private:
  std::optional<Timestamp> first_;
  Clock::time_point start_;
};

}  // namespace mms
