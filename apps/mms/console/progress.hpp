#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/status_line.hpp"
#include "mms/run/repeated_warnings.hpp"
#include "mms/run/run_observer.hpp"

namespace mms {

/// Shows a run on stderr: its heading, a progress line of at most 79 characters, and warnings. The
/// first Ctrl-C ends the run early.
class Progress : public RunObserver {
 public:
  /// @param quiet  only warnings
  explicit Progress(bool quiet = false) : quiet_(quiet) {}

  void on_start(const std::vector<std::string>& heading, std::size_t frames) override;
  void on_frame(const RunLog& log) override;
  void on_warning(const std::string& message) override;
  void on_end() override;
  bool stop_requested() const override { return InterruptGuard::requested(); }

 private:
  using Clock = std::chrono::steady_clock;

  std::string line(const RunLog& log) const;

  InterruptGuard interrupt_;
  StatusLine status_;
  RepeatedWarnings warnings_;
  bool quiet_ = false;
  std::size_t total_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace mms
