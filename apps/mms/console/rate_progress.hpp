#pragma once

#include <chrono>
#include <string>

#include "apps/mms/console/status_line.hpp"

namespace mms {

/// Shows the progress of work of known length on stderr, with rate and remaining time.
class RateProgress {
 public:
  /// @param what  name of the counted items: "frame", "image"
  explicit RateProgress(std::string what) : what_(std::move(what)) {}

  /// @param fresh  number of `done` since the start
  /// @param note   text to append
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
