#include "apps/mms/console/interrupt.hpp"

#include <atomic>
#include <csignal>

#include "mms/io/text/temporary_path.hpp"

namespace mms {
namespace {

std::atomic<bool> interrupt_requested = false;
std::atomic<int> interrupt_guards = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "signal handlers must not lock");

void on_interrupt(int signal) {
  if (interrupt_guards > 0 && !interrupt_requested.exchange(true)) return;
  remove_temporary_paths();
  std::signal(signal, SIG_DFL);
  static_cast<void>(std::raise(signal));  // ends the program when the handler returns
}

}  // namespace

void handle_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, on_interrupt) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

InterruptGuard::InterruptGuard() {
  if (interrupt_guards == 0) interrupt_requested = false;
  ++interrupt_guards;
}

InterruptGuard::~InterruptGuard() {
  --interrupt_guards;
}

bool InterruptGuard::requested() {
  return interrupt_requested;
}

}  // namespace mms
