#pragma once

#include <cstddef>
#include <vector>

namespace mms::engine {

/// From the first to the last operation (inclusive) that needs a buffer.
struct Lifetime {
  std::size_t bytes = 0;
  int first = 0;
  int last = 0;
};

/// Where buffers lie in one piece of memory.
struct MemoryPlan {
  std::vector<std::size_t> offsets;  ///< multiples of kAlignment, in the order of the buffers
  std::size_t bytes = 0;             ///< of the whole
};

inline constexpr std::size_t kAlignment = 64;

/// Places buffers so that none overlaps another that is needed at the same time: the largest first,
/// each as low as it fits.
MemoryPlan plan_memory(const std::vector<Lifetime>& buffers);

}  // namespace mms::engine
