#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace mms {

/// A status line on stderr: updated in place on a terminal, a new line every five seconds in a
/// pipe. Warnings may come from another thread.
class StatusLine {
 public:
  StatusLine();

  /// Whether to show a line now: at intervals, and always if it is the last one.
  bool due(bool last);

  void show(const std::string& text);
  void say(const std::string& message);  ///< in a separate line
  void warn(const std::string& message) { say("warning: " + message); }

  /// Ends the line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  std::mutex mutex_;
  bool terminal_;
  bool open_line_ = false;
  Clock::time_point shown_ = Clock::now();
};

}  // namespace mms
