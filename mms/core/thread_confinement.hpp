#pragma once

#include <atomic>
#include <thread>

namespace mms {

/// Belongs to an object without locks, which one thread at a time may use. The first thread that
/// uses the object owns it until `release`. Asserted by the owner class, so in debug builds only:
///   assert(confinement_.is_owner());
class ThreadConfinement {
 public:
  ThreadConfinement() = default;
  /// A copy of the object has no owner yet.
  ThreadConfinement(const ThreadConfinement&) {}
  /// The owner stays the same.
  ThreadConfinement& operator=(const ThreadConfinement&) { return *this; }

  /// Whether the calling thread owns the object; makes it the owner where there is none.
  bool is_owner() const {
    std::thread::id owner;
    const std::thread::id self = std::this_thread::get_id();
    return owner_.compare_exchange_strong(owner, self) || owner == self;
  }

  /// Lets another thread become the owner. The caller synchronizes both, for example by joining.
  void release() { owner_ = std::thread::id(); }

 private:
  mutable std::atomic<std::thread::id> owner_{};
};

}  // namespace mms
