#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "run_log.hpp"
#include "status_line.hpp"

namespace mms {

/// The progress of a run on stderr. Warnings may come from another thread than the frames.
class Progress {
 public:
  explicit Progress(std::size_t total) : total_(total) {}

  void show(const RunLog& log);
  void warn(const std::string& message) { status_.warn(message); }
  void finish() { status_.finish(); }

 private:
  using Clock = std::chrono::steady_clock;

  std::string line(const RunLog& log) const;

  StatusLine status_;
  std::size_t total_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace mms
