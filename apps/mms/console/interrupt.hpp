#pragma once

#include <array>
#include <csignal>
#include <stdexcept>
#include <string>

namespace mms {

/// During its lifetime the first Ctrl-C (SIGINT), SIGTERM or SIGHUP only requests an end, so that
/// results are written; the second one ends the program immediately. Signals that are ignored, as
/// SIGHUP by nohup, stay so. Guards may be nested.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether an end was requested since the outermost guard was created.
  static bool requested();

 private:
  static constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

  std::array<struct sigaction, kSignals.size()> before_{};
};

/// A command was interrupted and its output is not complete; the program ends with status 130, as
/// shells give it for SIGINT.
class Interrupted : public std::runtime_error {
 public:
  /// @param what  what there is of the output
  explicit Interrupted(const std::string& what) : std::runtime_error("interrupted: " + what) {}
};

}  // namespace mms
