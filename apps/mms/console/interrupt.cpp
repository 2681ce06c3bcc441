#include "apps/mms/console/interrupt.hpp"

namespace mms {
namespace {

volatile std::sig_atomic_t requested_flag = 0;
int guards = 0;  // only changed by the main thread

/// A second signal ends the program.
void on_signal(int) {
  requested_flag = 1;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    sigaction(signal, nullptr, &now);
    if (now.sa_handler == on_signal) std::signal(signal, SIG_DFL);
  }
}

}  // namespace

InterruptGuard::InterruptGuard() {
  if (guards++ == 0) requested_flag = 0;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN && !requested()) std::signal(kSignals[i], on_signal);
  }
}

InterruptGuard::~InterruptGuard() {
  --guards;
  if (requested()) return;  // the second signal ends the program
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

bool InterruptGuard::requested() {
  return requested_flag != 0;
}

}  // namespace mms
