#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "mms/segmentation/engine/convolution_kernel.hpp"
#include "mms/segmentation/engine/graph/graph.hpp"
#include "mms/segmentation/engine/memory_plan.hpp"

namespace mms::engine {

/// A graph ready to run: all its memory is laid out, all its operations are prepared. Running it
/// allocates nothing.
class Plan {
 public:
  /// Sees a value just after it was computed.
  using Observer = std::function<void(const Value&, const Tensor&)>;

  Plan(Graph graph, ConvolutionLibrary& library);
  Plan(const Plan&) = delete;  // the steps know where everything lies
  Plan& operator=(const Plan&) = delete;

  /// Where the image is to be written before each run.
  Tensor input() const { return tensor(graph_.input); }
  void run(const Observer& observer = {});

  /// The outputs may be read until the next run.
  Tensor tensor(ValueId id) const;
  const Graph& graph() const { return graph_; }
  /// Of all maps together.
  std::size_t bytes() const { return memory_.size(); }

 private:
  using Step = std::function<void()>;

  void lay_out();
  Step make(const Convolution& convolution, const Node& node);
  Step make(const MaxPooling& pooling, const Node& node);
  Step make(const Resizing& resizing, const Node& node);
  Step make(const Concatenation& concatenation, const Node& node);
  Step make(const Constant& constant, const Node& node);
  Step make(const GlobalContext& context, const Node& node);
  Step make(const Gate& gate, const Node& node);
  Step make(const Blending& blending, const Node& node);
  Step make(const GlobalBranch& branch, const Node& node);
  Step make(const GroupNorm& norm, const Node& node);
  Step make(const Conversion& conversion, const Node& node);

  Graph graph_;
  ConvolutionLibrary& library_;
  std::vector<std::size_t> offsets_;  ///< of the values
  std::vector<std::byte> memory_;
  std::byte* base_ = nullptr;  ///< the first aligned byte of `memory_`
  std::vector<Step> steps_;    ///< of the nodes
};

}  // namespace mms::engine
