#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace mms {

/// A line about what is going on, on stderr: rewritten in place on a terminal, a plain line every
/// five seconds when piped. Warnings may come from another thread.
class StatusLine {
 public:
  StatusLine();

  /// Whether a line is to be shown now: now and then, and always when it is the last one.
  bool due(bool last);

  void show(const std::string& text);
  void say(const std::string& message);  ///< in a line of its own, which stays
  void warn(const std::string& message) { say("warning: " + message); }

  /// Ends the line, so that what is printed next begins a new one.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  std::mutex mutex_;
  bool terminal_;
  bool open_line_ = false;
  Clock::time_point shown_ = Clock::now();
};

}  // namespace mms
