#include "mms/segmentation/engine/buffers.hpp"

#include <algorithm>

namespace mms::engine {
namespace {

constexpr int kBefore = -1;  // before the first operation

class BufferFinder {
 public:
  explicit BufferFinder(const Graph& graph)
      : graph_(graph), end_(static_cast<int>(graph.nodes.size())) {
    const std::size_t count = graph.values.size();
    first_.assign(count, kBefore);
    last_.assign(count, kBefore);
    buffers_.of_value.assign(count, -1);
  }

  Buffers find() {
    find_uses();
    open_buffer(graph_.input);
    for (int i = 0; i < end_; ++i) {
      const Node& node = graph_.nodes[static_cast<std::size_t>(i)];
      if (replaces_residual(node, i)) {
        share_buffer(node.inputs[1], node.output);
      } else {
        open_buffer(node.output);
      }
    }
    return std::move(buffers_);
  }

 private:
  static std::size_t at(ValueId id) { return static_cast<std::size_t>(id); }

  void find_uses() {
    for (int i = 0; i < end_; ++i) {
      const Node& node = graph_.nodes[static_cast<std::size_t>(i)];
      for (const ValueId input : node.inputs) last_[at(input)] = i;
      const bool constant = std::holds_alternative<Constant>(node.operation);
      first_[at(node.output)] = constant ? kBefore : i;
      if (constant) kept_.push_back(node.output);
    }
    GraphOutputs outputs = graph_.outputs;
    outputs.for_each([&](ValueId id) { kept_.push_back(id); });
    for (const ValueId id : kept_) last_[at(id)] = end_;
  }

  bool replaces_residual(const Node& node, int index) const {
    if (!std::holds_alternative<Convolution>(node.operation) || node.inputs.size() < 2) {
      return false;
    }
    const ValueId residual = node.inputs[1];
    return residual != node.inputs[0] && residual != graph_.input && last_[at(residual)] == index;
  }

  void open_buffer(ValueId id) {
    const Value& value = graph_.value(id);
    const auto bytes = static_cast<std::size_t>(value.shape.count() * value.format.bytes());
    buffers_.of_value[at(id)] = static_cast<int>(buffers_.lifetimes.size());
    buffers_.lifetimes.push_back({bytes, first_[at(id)], std::max(first_[at(id)], last_[at(id)])});
  }

  void share_buffer(ValueId from, ValueId to) {
    const int buffer = buffers_.of_value[at(from)];
    buffers_.of_value[at(to)] = buffer;
    Lifetime& lifetime = buffers_.lifetimes[static_cast<std::size_t>(buffer)];
    lifetime.last = std::max(lifetime.last, last_[at(to)]);
  }

  const Graph& graph_;
  int end_;
  std::vector<int> first_;  ///< operation that computes a value
  std::vector<int> last_;   ///< last operation that uses it
  std::vector<ValueId> kept_;
  Buffers buffers_;
};

}  // namespace

Buffers find_buffers(const Graph& graph) {
  return BufferFinder(graph).find();
}

}  // namespace mms::engine
