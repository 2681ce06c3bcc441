#include "apps/mms/console/status_line.hpp"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

#include "apps/mms/console/warnings.hpp"

namespace mms {
namespace {

constexpr std::chrono::milliseconds kTerminalPeriod{200};
constexpr std::chrono::seconds kPipePeriod{5};
constexpr std::size_t kColumns = 79;  // of a terminal of unknown width

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
    winsize size{};
    const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    const std::size_t columns = is_known ? size.ws_col - 1U : kColumns;
    fmt::print(stderr, "\r\033[K{}", text.substr(0, columns));  // a wrapped line stays
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
