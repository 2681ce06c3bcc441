#include "apps/mms/console/status_line.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>

#include "apps/mms/console/warnings.hpp"

namespace mms {
namespace {

constexpr std::chrono::milliseconds kTerminalPeriod{200};
constexpr std::chrono::seconds kPipePeriod{5};

}  // namespace

StatusLine::StatusLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

bool StatusLine::due(bool last) {
  const std::scoped_lock lock(mutex_);
  const Clock::time_point now = Clock::now();
  const auto period = terminal_ ? Clock::duration(kTerminalPeriod) : Clock::duration(kPipePeriod);
  if (!last && now - shown_ < period) return false;
  shown_ = now;
  return true;
}

void StatusLine::show(const std::string& text) {
  const std::scoped_lock lock(mutex_);
  if (terminal_) {
    fmt::print(stderr, "\r\033[K{}", text);
    open_line_ = true;
  } else {
    fmt::print(stderr, "{}\n", text);
  }
  std::fflush(stderr);
}

void StatusLine::say(const std::string& message) {
  const std::scoped_lock lock(mutex_);
  fmt::print(stderr, "{}{}\n", open_line_ ? "\r\033[K" : "", printable(message));
  open_line_ = false;
}

void StatusLine::finish() {
  const std::scoped_lock lock(mutex_);
  if (open_line_) fmt::print(stderr, "\n");
  open_line_ = false;
}

}  // namespace mms
