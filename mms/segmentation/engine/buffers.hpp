#pragma once

#include <vector>

#include "mms/segmentation/engine/graph/graph.hpp"
#include "mms/segmentation/engine/memory_plan.hpp"

namespace mms::engine {

/// Which values of a graph share a buffer, and when each buffer is needed.
struct Buffers {
  std::vector<int> of_value;  ///< index of a value's buffer
  std::vector<Lifetime> lifetimes;
};

/// A convolution's result replaces its residual where nothing else needs that any more; all other
/// values have buffers of their own. The image, constants and outputs are never replaced.
Buffers find_buffers(const Graph& graph);

}  // namespace mms::engine
