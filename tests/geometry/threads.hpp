#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace mms::testing {

/// Result of `work` on exactly `threads` threads, however many cores the machine has.
template <class Work>
auto on_threads(int threads, const Work& work) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute([&] { return work(); });
}

}  // namespace mms::testing
