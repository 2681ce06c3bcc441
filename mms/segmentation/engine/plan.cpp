#include "mms/segmentation/engine/plan.hpp"

#include <algorithm>
#include <cstring>
#include <optional>

#include "mms/segmentation/engine/buffers.hpp"
#include "mms/segmentation/engine/map_operations.hpp"

namespace mms::engine {

Plan::Plan(Graph graph, ConvolutionLibrary& library) : graph_(std::move(graph)), library_(library) {
  lay_out();
  for (const Node& node : graph_.nodes) {
    steps_.push_back(
        std::visit([&](const auto& operation) { return make(operation, node); }, node.operation));
  }
}

void Plan::lay_out() {
  const Buffers buffers = find_buffers(graph_);
  const MemoryPlan plan = plan_memory(buffers.lifetimes);
  for (const int buffer : buffers.of_value) {
    offsets_.push_back(buffer < 0 ? 0 : plan.offsets[static_cast<std::size_t>(buffer)]);
  }
  memory_.resize(plan.bytes + kAlignment);
  void* start = memory_.data();
  std::size_t space = memory_.size();
  base_ = static_cast<std::byte*>(std::align(kAlignment, plan.bytes, start, space));
}

Tensor Plan::tensor(ValueId id) const {
  const Value& value = graph_.value(id);
  return {value.shape, value.format, base_ + offsets_[static_cast<std::size_t>(id)]};
}

void Plan::run(const Observer& observer) {
  if (observer) observer(graph_.value(graph_.input), input());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    steps_[i]();
    const ValueId output = graph_.nodes[i].output;
    if (observer) observer(graph_.value(output), tensor(output));
  }
}

Plan::Step Plan::make(const Convolution& convolution, const Node& node) {
  const Tensor x = tensor(node.inputs[0]);
  const Tensor y = tensor(node.output);
  std::optional<Tensor> residual;
  if (node.inputs.size() > 1) residual = tensor(node.inputs[1]);
  const auto format = residual ? std::optional(residual->format) : std::nullopt;
  const auto kernel =
      std::make_shared<ConvolutionKernel>(library_, convolution.layer, x, y, format);
  if (!residual || residual->data == y.data) {
    return [kernel, this] { kernel->run(library_.stream()); };
  }
  const auto bytes = static_cast<std::size_t>(y.shape.count() * y.format.bytes());
  return [kernel, from = residual->data, to = y.data, bytes, this] {
    std::memcpy(to, from, bytes);
    kernel->run(library_.stream());
  };
}

Plan::Step Plan::make(const MaxPooling& pooling, const Node& node) {
  const Tensor x = tensor(node.inputs[0]);
  const Tensor y = tensor(node.output);
  const auto both = [](int length) { return dnnl::memory::dims{length, length}; };
  const dnnl::pooling_forward::primitive_desc what(
      {dnnl::prop_kind::forward_inference, dnnl::algorithm::pooling_max, description(x),
       description(y), both(pooling.stride), both(pooling.kernel), both(pooling.padding),
       both(pooling.padding)},
      library_.engine());
  const dnnl::memory from(description(x), library_.engine(), x.data);
  const dnnl::memory to(description(y), library_.engine(), y.data);
  return
      [primitive = dnnl::pooling_forward(what),
       arguments = std::unordered_map<int, dnnl::memory>{{DNNL_ARG_SRC, from}, {DNNL_ARG_DST, to}},
       this] { primitive.execute(library_.stream(), arguments); };
}

Plan::Step Plan::make(const Resizing& resizing, const Node& node) {
  const Tensor x = tensor(node.inputs[0]);
  const Tensor y = tensor(node.output);
  return [resizer = Resizer(resizing, x.shape, y.shape), x, y, addend = tensor(node.inputs.back()),
          adds = node.inputs.size() > 1] { resizer.run(x, adds ? &addend : nullptr, y); };
}

Plan::Step Plan::make(const Concatenation&, const Node& node) {
  std::vector<Tensor> parts;
  for (const ValueId input : node.inputs) parts.push_back(tensor(input));
  return [parts, y = tensor(node.output)] { concatenate(parts, y); };
}

Plan::Step Plan::make(const Constant& constant, const Node& node) {
  std::copy(constant.values.begin(), constant.values.end(), tensor(node.output).floats());
  return [] {};
}

Plan::Step Plan::make(const GlobalContext& context, const Node& node) {
  const bool adds = node.inputs.size() > 1;
  return
      [&context, x = tensor(node.inputs[0]), residual = tensor(node.inputs.back()), adds,
       y = tensor(node.output)] { add_global_context(context, x, adds ? &residual : nullptr, y); };
}

Plan::Step Plan::make(const Gate& gate, const Node& node) {
  const Tensor x = tensor(node.inputs[0]);
  const auto pixels = static_cast<std::size_t>(x.shape.pixels());
  const auto scratch = std::make_shared<std::vector<float>>(pixels);
  return [&gate, x, scratch, y = tensor(node.output)] { compute_gate(gate, x, *scratch, y); };
}

Plan::Step Plan::make(const Blending&, const Node& node) {
  return [a = tensor(node.inputs[0]), b = tensor(node.inputs[1]), gate = tensor(node.inputs[2]),
          y = tensor(node.output)] { blend(a, b, gate, y); };
}

Plan::Step Plan::make(const GlobalBranch& branch, const Node& node) {
  return [&branch, x = tensor(node.inputs[0]), y = tensor(node.output)] {
    compute_global_branch(branch, x, y);
  };
}

Plan::Step Plan::make(const GroupNorm& norm, const Node& node) {
  return [&norm, x = tensor(node.inputs[0]), y = tensor(node.output)] {
    normalise_groups(norm, x, y);
  };
}

Plan::Step Plan::make(const Conversion&, const Node& node) {
  return [x = tensor(node.inputs[0]), y = tensor(node.output)] { convert(x, y); };
}

}  // namespace mms::engine
