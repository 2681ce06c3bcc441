#pragma once

namespace mms {

/// While one lives, the first Ctrl-C (SIGINT) or SIGTERM only asks the program to come to an end,
/// so that what was done so far is written; the second ends it at once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether the program was asked to end since the guard was made.
  static bool requested();
};

}  // namespace mms
