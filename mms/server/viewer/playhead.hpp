#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>

#include "mms/core/time.hpp"

namespace mms {

/// Position of one viewer in a run: the newest frame of a live run, or playback of a finished one
/// in real time. Time is passed as an argument.
class Playhead {
 public:
  using Clock = std::chrono::steady_clock;

  /// Moves to the newest frame of a live run, unless paused.
  /// @param frames  number of frames
  void follow(std::size_t frames);

  /// Advances playback of a finished run.
  /// @param stamps  of all frames, in order of time
  void advance(std::span<const Timestamp> stamps, Clock::time_point now);

  void play(Clock::time_point now);
  void pause() { playing_ = false; }
  void step(int by);  ///< pauses
  void seek(
      std::size_t frame);  ///< pauses a live run, which would otherwise move to the newest frame
  void set_speed(double speed, Clock::time_point now);

  bool playing() const { return playing_; }
  bool ended() const { return ended_; }  ///< at the last frame of a finished run
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
  std::optional<Clock::time_point> start_;  // time at which playback started from start_frame_
  std::size_t start_frame_ = 0;
};

}  // namespace mms
