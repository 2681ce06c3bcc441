#include "mms/server/viewer/playhead.hpp"

#include <algorithm>

namespace mms {

void Playhead::follow(std::size_t frames) {
  live_ = true;
  clamp(frames);
  if (playing_ && frames > 0) frame_ = frames - 1;
}

void Playhead::advance(std::span<const Timestamp> stamps, Clock::time_point now) {
  clamp(stamps.size());
  if (stamps.empty()) return;
  if (live_) start_.reset();  // the run has ended
  live_ = false;
  if (playing_) {
    if (!start_) restart(now);
    const std::chrono::duration<double> elapsed = now - *start_;
    const Timestamp shown = stamps[std::min(start_frame_, stamps.size() - 1)] +
                            std::chrono::duration_cast<Duration>(elapsed * speed_);
    const auto next = std::upper_bound(stamps.begin(), stamps.end(), shown);
    const auto passed = static_cast<std::size_t>(next - stamps.begin());
    frame_ = std::max(frame_, passed - std::min<std::size_t>(passed, 1));
  }
  ended_ = frame_ + 1 == stamps.size();
  if (ended_) playing_ = false;
}

void Playhead::play(Clock::time_point now) {
  if (ended_) frame_ = 0;
  playing_ = true;
  ended_ = false;
  restart(now);
}

void Playhead::step(int by) {
  const auto back = static_cast<std::size_t>(by < 0 ? -static_cast<long>(by) : 0);
  seek(by < 0 ? frame_ - std::min(frame_, back) : frame_ + static_cast<std::size_t>(by));
  playing_ = false;
}

void Playhead::seek(std::size_t frame) {
  frame_ = frame;
  ended_ = false;
  start_.reset();
  if (live_) playing_ = false;
}

void Playhead::set_speed(double speed, Clock::time_point now) {
  speed_ = speed;
  restart(now);
}

/// Limits the position to existing frames.
void Playhead::clamp(std::size_t frames) {
  frame_ = std::min(frame_, std::max<std::size_t>(frames, 1) - 1);
}

void Playhead::restart(Clock::time_point now) {
  start_ = now;
  start_frame_ = frame_;
}

}  // namespace mms
