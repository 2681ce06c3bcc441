#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "mms/segmentation/engine/convolution_kernel.hpp"
#include "mms/segmentation/engine/graph/graph.hpp"
#include "mms/segmentation/engine/memory_plan.hpp"

namespace mms::engine {

/// A graph ready to run: memory is allocated and all operations are prepared. Running it allocates
/// nothing.
class Plan {
 public:
  /// Called with a value right after its computation.
  using Observer = std::function<void(const Value&, const Tensor&)>;

  Plan(Graph graph, ConvolutionLibrary& library);
  Plan(const Plan&) = delete;  // the steps store addresses
  Plan& operator=(const Plan&) = delete;

  /// The input image, to be written before each run.
  Tensor input() const { return tensor(graph_.input); }
  void run(const Observer& observer = {});

  /// Outputs are valid until the next run.
  Tensor tensor(ValueId id) const;
  const Graph& graph() const { return graph_; }
  /// Total size of all maps.
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
  std::byte* base_ = nullptr;  ///< first aligned byte of `memory_`
  std::vector<Step> steps_;    ///< of the nodes
};

}  // namespace mms::engine
