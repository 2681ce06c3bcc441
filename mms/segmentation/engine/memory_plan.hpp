#pragma once

#include <cstddef>
#include <vector>

namespace mms::engine {

/// First and last operation (inclusive) that use a buffer.
struct Lifetime {
  std::size_t bytes = 0;
  int first = 0;
  int last = 0;
};

/// Positions of buffers in one block of memory.
struct MemoryPlan {
  std::vector<std::size_t> offsets;  ///< multiples of kAlignment, in the order of the buffers
  std::size_t bytes = 0;             ///< total size
};

inline constexpr std::size_t kAlignment = 64;

/// Places buffers without overlap of those with overlapping lifetimes: the largest first, each at
/// the lowest free offset.
MemoryPlan plan_memory(const std::vector<Lifetime>& buffers);

}  // namespace mms::engine
