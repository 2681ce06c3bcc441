#pragma once

namespace mms {

/// During its lifetime the first Ctrl-C (SIGINT) or SIGTERM only requests an end, so that results
/// are written; the second one ends the program immediately.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether an end was requested since the guard was created.
  static bool requested();
};

}  // namespace mms
