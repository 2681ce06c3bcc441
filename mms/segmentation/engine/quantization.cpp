#include "mms/segmentation/engine/quantization.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/segmentation/engine/tensor.hpp"

namespace mms::engine {
namespace {

class Quantizer {
 public:
  Quantizer(const Graph& graph, const Quantization& quantization)
      : quantization_(quantization), graph_(graph) {
    graph_.nodes.clear();
  }

  Graph run(const std::vector<Node>& nodes) {
    for (const Node& node : nodes) {
      Node copy = node;
      choose_format(copy);
      graph_.nodes.push_back(std::move(copy));
    }
    return std::move(graph_);
  }

 private:
  bool is_known(ValueId id) const { return quantization_.ranges.contains(graph_.value(id).name); }

  Format bytes_of(ValueId id) const {
    const Value& value = graph_.value(id);
    return byte_format(quantization_.ranges.at(value.name), value.non_negative);
  }

  bool in_bytes(ValueId id) const { return graph_.value(id).format.number != Number::kFloat; }

  void choose_format(Node& node) {
    if (std::holds_alternative<Convolution>(node.operation)) {
      choose_convolution(node);
    } else if (std::holds_alternative<MaxPooling>(node.operation)) {
      graph_.value(node.output).format = graph_.value(node.inputs[0]).format;
    } else if (is_int8(node) && may_be_int8(node.output)) {
      graph_.value(node.output).format = bytes_of(node.output);
    }
    if (is_int8(node)) int8_values_.insert(node.output);
  }

  bool may_be_int8(ValueId id) const { return !graph_.value(id).keep_float && is_known(id); }

  /// Whether all inputs of the node come from quantized convolutions, so that int8 costs no
  /// accuracy.
  bool is_int8(const Node& node) const {
    if (const auto* convolution = std::get_if<Convolution>(&node.operation)) {
      return is_quantized(*convolution->layer, node.inputs[0]);
    }
    if (std::holds_alternative<Constant>(node.operation)) return false;
    return std::all_of(node.inputs.begin(), node.inputs.end(),
                       [&](ValueId id) { return int8_values_.contains(id) || is_constant(id); });
  }

  bool is_quantized(const ConvLayer& layer, ValueId input) const {
    return is_known(input) && !quantization_.float_layers.contains(layer.name);
  }

  bool is_constant(ValueId id) const {
    return std::any_of(graph_.nodes.begin(), graph_.nodes.end(), [&](const Node& node) {
      return node.output == id && std::holds_alternative<Constant>(node.operation);
    });
  }

  void choose_convolution(Node& node) {
    const ConvLayer& layer = *std::get<Convolution>(node.operation).layer;
    if (!is_quantized(layer, node.inputs[0])) {
      for (ValueId& input : node.inputs) input = in_format(input, Format{});
      return;
    }
    node.inputs[0] = in_some_bytes(node.inputs[0]);
    if (may_be_int8(node.output)) graph_.value(node.output).format = bytes_of(node.output);
    if (node.inputs.size() < 2) return;
    ValueId& residual = node.inputs[1];
    residual = in_bytes(node.output) ? in_some_bytes(residual) : in_format(residual, Format{});
  }

  ValueId in_some_bytes(ValueId id) { return in_bytes(id) ? id : in_format(id, bytes_of(id)); }

  ValueId in_format(ValueId id, const Format& format) {
    if (graph_.value(id).format == format) return id;
    const auto known = conversions_.find({id, format.number});
    if (known != conversions_.end()) return known->second;
    const auto converted = static_cast<ValueId>(graph_.values.size());
    Value value = graph_.value(id);
    value.name += format.number == Number::kFloat ? " in float32" : " in int8";
    value.format = format;
    graph_.values.push_back(std::move(value));
    graph_.nodes.push_back({Conversion{}, {id}, converted});
    return conversions_[{id, format.number}] = converted;
  }

  const Quantization& quantization_;
  Graph graph_;
  std::set<ValueId> int8_values_;
  std::map<std::pair<ValueId, Number>, ValueId> conversions_;
};

constexpr std::string_view kRange = "quantization.range.";
constexpr const char* kFloatLayers = "quantization.float_layers";

float range_of(const std::string& text, const std::string& name, const std::string& where) {
  float range = 0.0F;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), range);
  const bool whole = fault == std::errc() && end == text.data() + text.size();
  if (whole && std::isfinite(range) && range > 0.0F) return range;
  throw DataError(where, name + " is '" + text + "', expected a positive number",
                  "write it again with mms quantize");
}

}  // namespace

void pack_quantization(const Quantization& quantization, Weights& weights) {
  std::erase_if(weights.metadata,
                [](const auto& entry) { return entry.first.starts_with("quantization."); });
  for (const auto& [name, range] : quantization.ranges) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.begin(), text.end(), range).ptr;
    weights.metadata[std::string(kRange) + name] = std::string(text.begin(), end);
  }
  std::string layers;
  for (const std::string& layer : quantization.float_layers) {
    layers += (layers.empty() ? "" : ",") + layer;
  }
  weights.metadata[kFloatLayers] = layers;
}

Quantization unpack_quantization(const Weights& weights, const std::string& where) {
  Quantization quantization;
  for (const auto& [name, text] : weights.metadata) {
    if (!name.starts_with(kRange)) continue;
    quantization.ranges[name.substr(kRange.size())] = range_of(text, name, where);
  }
  const auto layers = weights.metadata.find(kFloatLayers);
  if (layers == weights.metadata.end()) return quantization;
  std::istringstream stream(layers->second);
  for (std::string name; std::getline(stream, name, ',');) quantization.float_layers.insert(name);
  return quantization;
}

void check_quantization(const Quantization& quantization, const Graph& graph,
                        const std::string& where) {
  if (quantization.ranges.empty()) return;
  constexpr const char* kHint = "quantize the weights again with mms quantize";
  std::set<std::string> names;
  for (const Value& value : graph.values) {
    names.insert(value.name);
    if (quantization.ranges.contains(value.name)) continue;
    throw DataError(where, "has no range for the value '" + value.name + "' for int8", kHint);
  }
  for (const auto& [name, range] : quantization.ranges) {
    if (names.contains(name)) continue;
    throw DataError(where, "has an int8 range for '" + name + "', which the network does not have",
                    kHint);
  }
}

Graph quantized(const Graph& graph, const Quantization& quantization) {
  return Quantizer(graph, quantization).run(graph.nodes);
}

}  // namespace mms::engine
