#pragma once

#include <vector>

#include "mms/segmentation/engine/graph/graph.hpp"
#include "mms/segmentation/engine/memory_plan.hpp"

namespace mms::engine {

/// Assignment of a graph's values to buffers, and lifetimes of the buffers.
struct Buffers {
  std::vector<int> of_value;  ///< index of a value's buffer
  std::vector<Lifetime> lifetimes;
};

/// A convolution's result replaces its residual if no later operation needs it; all other values
/// have their own buffers. The image, constants and outputs are never replaced.
Buffers find_buffers(const Graph& graph);

}  // namespace mms::engine
