#pragma once

#include <stdexcept>
#include <string>

namespace mms {

/// Lets Ctrl-C (SIGINT), SIGTERM and SIGHUP remove temporary files before they end the program, if
/// no `InterruptGuard` prevents it. Signals that are ignored, as SIGHUP by nohup, stay so. To be
/// called once.
void handle_interrupts();

/// During its lifetime the first of these signals only requests an end, so that results are
/// written; the second one ends the program immediately. Guards may be nested.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether an end was requested since the outermost guard was created.
  static bool requested();
};

/// A command was interrupted and its output is not complete; the program ends with status 130, as
/// shells give it for SIGINT.
class Interrupted : public std::runtime_error {
 public:
  /// @param what  what there is of the output
  explicit Interrupted(const std::string& what) : std::runtime_error("interrupted: " + what) {}
};

}  // namespace mms
