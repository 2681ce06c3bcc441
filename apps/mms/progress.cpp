#include "progress.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>

#include "mms/pipeline/frame_result.hpp"

namespace mms {
namespace {

constexpr std::chrono::milliseconds kTerminalPeriod{200};
constexpr std::chrono::seconds kPipePeriod{5};

}  // namespace

Progress::Progress(std::size_t total) : total_(total), terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::show(const RunLog& log, const DynamicMap& objects) {
  const std::scoped_lock lock(mutex_);
  const Clock::time_point now = Clock::now();
  const bool last = log.frames().size() >= total_;
  const auto period = terminal_ ? Clock::duration(kTerminalPeriod) : Clock::duration(kPipePeriod);
  if (!last && now - shown_ < period) return;
  shown_ = now;
  if (terminal_) {
    fmt::print(stderr, "\r\033[K{}", line(log, objects));
    open_line_ = true;
  } else {
    fmt::print(stderr, "{}\n", line(log, objects));
  }
  std::fflush(stderr);
}

void Progress::warn(const std::string& message) {
  const std::scoped_lock lock(mutex_);
  fmt::print(stderr, "{}warning: {}\n", open_line_ ? "\r\033[K" : "", message);
  open_line_ = false;
}

void Progress::finish() {
  const std::scoped_lock lock(mutex_);
  if (open_line_) fmt::print(stderr, "\n");
  open_line_ = false;
}

std::string Progress::line(const RunLog& log, const DynamicMap& objects) const {
  const std::chrono::duration<double> elapsed = Clock::now() - start_;
  const LoggedFrame& frame = log.frames().back();
  std::string stages;
  for (std::size_t i = 0; i < kStageCount; ++i) {
    stages += fmt::format(" {} {:.1f}", to_string(static_cast<Stage>(i)), frame.stage_ms[i]);
  }
  return fmt::format("frame {}/{}  {:.1f} Hz  ms:{}  dynamic {:.0f} %  objects {}  {}",
                     log.frames().size(), total_,
                     static_cast<double>(log.frames().size()) / elapsed.count(), stages,
                     100.0 * frame.dynamic_share, objects.active().size(), to_string(frame.status));
}

}  // namespace mms
