#pragma once

#include <chrono>
#include <string>

#include "apps/mms/console/status_line.hpp"

namespace mms {

/// Progress of work whose length is known, on stderr, with its rate and the time left.
class RateProgress {
 public:
  /// @param what  that is counted: "frame", "image"
  explicit RateProgress(std::string what) : what_(std::move(what)) {}

  /// @param fresh  how many of `done` were done since the start, and not before
  /// @param note   what to say behind it
  void show(int done, int total, int fresh, const std::string& note = "");
  void show(int done, int total) { show(done, total, done); }
  void say(const std::string& message) { status_.say(message); }
  void warn(const std::string& message) { status_.warn(message); }
  void finish() { status_.finish(); }

  double seconds() const;  ///< since the start

 private:
  using Clock = std::chrono::steady_clock;

  StatusLine status_;
  std::string what_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace mms
