#include "mms/segmentation/engine/graph/graph_builder.hpp"

#include <algorithm>
#include <utility>

namespace mms::engine {
namespace {

std::vector<ValueId> present(ValueId x, ValueId other) {
  return other == GraphBuilder::kNone ? std::vector<ValueId>{x} : std::vector<ValueId>{x, other};
}

int strided(int length, int stride) {
  return (length + stride - 1) / stride;
}

}  // namespace

GraphBuilder::GraphBuilder(const Shape& input) {
  graph_.values.push_back({.name = "image", .shape = input});
}

ValueId GraphBuilder::append(Operation operation, std::vector<ValueId> inputs,
                             const std::string& name, const Shape& shape, bool non_negative) {
  const auto id = static_cast<ValueId>(graph_.values.size());
  const int same = ++names_[name];
  graph_.values.push_back({.name = same == 1 ? name : name + " " + std::to_string(same),
                           .shape = shape,
                           .non_negative = non_negative});
  graph_.nodes.push_back({std::move(operation), std::move(inputs), id});
  return id;
}

bool GraphBuilder::non_negative(const std::vector<ValueId>& ids) const {
  return std::all_of(ids.begin(), ids.end(),
                     [&](ValueId id) { return graph_.value(id).non_negative; });
}

ValueId GraphBuilder::convolution(const ConvLayerPtr& layer, ValueId x, ValueId residual) {
  const Shape& in = shape(x);
  const Shape out = {strided(in.height, layer->stride), strided(in.width, layer->stride),
                     layer->out};
  return append(Convolution{layer}, present(x, residual), layer->name, out, layer->relu);
}

ValueId GraphBuilder::max_pooling(const MaxPooling& pooling, ValueId x) {
  const Shape& in = shape(x);
  const auto length = [&](int n) {
    return (n + 2 * pooling.padding - pooling.kernel) / pooling.stride + 1;
  };
  const Shape out = {length(in.height), length(in.width), in.channels};
  return append(pooling, {x}, "pooled", out, non_negative({x}));
}

ValueId GraphBuilder::resized(bool bilinear, ValueId x, int height, int width, ValueId addend) {
  const Shape out = {height, width, shape(x).channels};
  std::vector<ValueId> inputs = present(x, addend);
  const bool positive = non_negative(inputs);
  return append(Resizing{bilinear}, std::move(inputs), "resized", out, positive);
}

ValueId GraphBuilder::concatenation(const std::vector<ValueId>& parts) {
  Shape out = shape(parts.front());
  out.channels = 0;
  for (const ValueId part : parts) out.channels += shape(part).channels;
  return append(Concatenation{}, parts, "concatenated", out, non_negative(parts));
}

ValueId GraphBuilder::constant(const Shape& shape, std::vector<float> values,
                               const std::string& name) {
  return append(Constant{std::move(values)}, {}, name, shape, false);
}

ValueId GraphBuilder::global_context(GlobalContext context, ValueId x, ValueId residual) {
  const std::string name = context.layer->name;
  const bool relu = context.relu;
  return append(std::move(context), present(x, residual), name, shape(x), relu);
}

ValueId GraphBuilder::gate(Gate gate, ValueId x) {
  const Shape out = {strided(shape(x).height, gate.stride), strided(shape(x).width, gate.stride),
                     1};
  const ValueId id = append(std::move(gate), {x}, "gate", out, false);
  graph_.value(id).keep_float = true;
  return id;
}

ValueId GraphBuilder::blending(ValueId a, ValueId b, ValueId gate) {
  graph_.value(a).keep_float = true;
  graph_.value(b).keep_float = true;
  return append(Blending{}, {a, b, gate}, "blended", shape(a), false);
}

ValueId GraphBuilder::global_branch(const ConvLayerPtr& layer, ValueId x) {
  const Shape out = {shape(x).height, shape(x).width, layer->out};
  return append(GlobalBranch{layer}, {x}, layer->name, out, true);
}

ValueId GraphBuilder::group_norm(GroupNorm norm, ValueId x) {
  graph_.value(x).keep_float = true;
  return append(std::move(norm), {x}, "normalised", shape(x), true);
}

Graph GraphBuilder::finish(const GraphOutputs& outputs) {
  graph_.outputs = outputs;
  graph_.outputs.for_each([&](ValueId id) { graph_.value(id).keep_float = true; });
  return std::move(graph_);
}

}  // namespace mms::engine
