#include "apps/mms/console/interrupt.hpp"

#include <csignal>

namespace mms {
namespace {

volatile std::sig_atomic_t requested_flag = 0;

void handle_both(void (*handler)(int)) {
  std::signal(SIGINT, handler);
  std::signal(SIGTERM, handler);
}

/// A second signal ends the program.
void on_signal(int) {
  requested_flag = 1;
  handle_both(SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  requested_flag = 0;
  handle_both(on_signal);
}

InterruptGuard::~InterruptGuard() {
  handle_both(SIG_DFL);
}

bool InterruptGuard::requested() {
  return requested_flag != 0;
}

}  // namespace mms
