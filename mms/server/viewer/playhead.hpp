#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>

#include "mms/core/time.hpp"

namespace mms {

/// Where in a run one viewer is: at the newest frame of a live run, or on its way through the
/// frames of a finished one at the pace of their stamps. Time is given to it: it has no clock.
class Playhead {
 public:
  using Clock = std::chrono::steady_clock;

  /// Goes to the newest of a live run's frames, unless paused. @param frames  how many there are
  void follow(std::size_t frames);

  /// Goes to where playing is now in a finished run. @param stamps  of all frames, by time
  void advance(std::span<const Timestamp> stamps, Clock::time_point now);

  void play(Clock::time_point now);
  void pause() { playing_ = false; }
  void step(int by);             ///< pauses
  void seek(std::size_t frame);  ///< pauses a live run, which would go on to the newest
  void set_speed(double speed, Clock::time_point now);

  bool playing() const { return playing_; }
  bool ended() const { return ended_; }  ///< at a finished run's last frame
  bool follows() const { return live_ && playing_; }
  std::size_t frame() const { return frame_; }
  double speed() const { return speed_; }

 private:
  void restart(Clock::time_point now);
  void clamp(std::size_t frames);

  bool live_ = false;
  bool playing_ = true;
  bool ended_ = false;
  std::size_t frame_ = 0;
  double speed_ = 1.0;
  std::optional<Clock::time_point> start_;  // when playing went on, at start_frame_
  std::size_t start_frame_ = 0;
};

}  // namespace mms
