#pragma once

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace mms {

/// Tells the thread sanitizer what TBB guarantees, since Debian's TBB is built without it: what the
/// caller did before happens before its tasks, and these before what it does next. Does nothing in
/// other builds.
class TaskOrder {
 public:
  TaskOrder() { release(begin_); }
  /// After the last task.
  ~TaskOrder() { acquire(end_); }
  TaskOrder(const TaskOrder&) = delete;
  TaskOrder& operator=(const TaskOrder&) = delete;

  /// Runs one of the tasks.
  template <class Task>
  void run(const Task& task) {
    acquire(begin_);
    task();
    release(end_);
  }

 private:
#if defined(__SANITIZE_THREAD__)
  static void acquire(char& place) {
    __tsan_acquire(&place);
  }
  static void release(char& place) {
    __tsan_release(&place);
  }
#else
  static void acquire(char&) {}
  static void release(char&) {}
#endif

  char begin_ = 0;
  char end_ = 0;
};

}  // namespace mms
