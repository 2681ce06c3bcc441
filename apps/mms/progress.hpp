#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "mms/mapping/dynamic_map.hpp"
#include "run_log.hpp"

namespace mms {

/// The progress line on stderr: rewritten in place on a terminal, a plain line every five seconds
/// when piped. Warnings may come from another thread than the frames.
class Progress {
 public:
  explicit Progress(std::size_t total);

  void show(const RunLog& log, const DynamicMap& objects);
  void warn(const std::string& message);
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  std::string line(const RunLog& log, const DynamicMap& objects) const;

  std::mutex mutex_;
  std::size_t total_;
  bool terminal_;
  bool open_line_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = start_;
};

}  // namespace mms
