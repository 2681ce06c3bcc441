#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/status_line.hpp"
#include "mms/run/run_observer.hpp"

namespace mms {

/// Shows the progress of a run on stderr; the first Ctrl-C ends the run early.
class Progress : public RunObserver {
 public:
  void on_start(std::size_t frames) override;
  void on_frame(const RunLog& log) override;
  void on_warning(const std::string& message) override { status_.warn(message); }
  void on_end() override { status_.finish(); }
  bool stop_requested() const override { return InterruptGuard::requested(); }

 private:
  using Clock = std::chrono::steady_clock;

  std::string line(const RunLog& log) const;

  InterruptGuard interrupt_;
  StatusLine status_;
  std::size_t total_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace mms
