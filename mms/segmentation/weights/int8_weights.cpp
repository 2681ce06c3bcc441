#include "mms/segmentation/weights/int8_weights.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr float kMaxInt8 = 127.0F;
constexpr std::string_view kScale = "_scale";

/// The values of one output channel.
std::span<float> channel(WeightTensor& tensor, std::size_t index) {
  const std::size_t count = tensor.values.size() / static_cast<std::size_t>(tensor.shape[0]);
  return std::span(tensor.values).subspan(index * count, count);
}

/// The step of a channel, whose values are rounded to multiples of it.
float round_to_bytes(std::span<float> values) {
  float largest = 0.0F;
  for (const float value : values) largest = std::max(largest, std::abs(value));
  const float step = largest / kMaxInt8;
  for (float& value : values) value = largest > 0.0F ? std::round(value / step) : 0.0F;
  return step;
}

void multiply(WeightTensor& tensor, const std::string& name, const WeightTensor& steps,
              const std::string& where) {
  if (tensor.shape.empty() || steps.shape != std::vector{tensor.shape[0]}) {
    throw DataError(where,
                    "'" + name + std::string(kScale) + "' has " +
                        std::to_string(steps.values.size()) +
                        " steps, expected one for each output channel of '" + name + "'",
                    "write it with mms quantize");
  }
  for (std::size_t i = 0; i < steps.values.size(); ++i) {
    for (float& value : channel(tensor, i)) {
      value *= steps.values[i];
      if (std::isfinite(value)) continue;
      throw DataError(where, "'" + name + "' is too large for a float with the step " +
                                 std::to_string(steps.values[i]));
    }
  }
}

}  // namespace

Weights to_bytes(Weights weights, const std::set<std::string>& names) {
  for (const std::string& name : names) {
    WeightTensor& tensor = weights.tensors.at(name);
    WeightTensor steps{{tensor.shape.at(0)}, {}};
    for (std::size_t i = 0; i < static_cast<std::size_t>(tensor.shape[0]); ++i) {
      steps.values.push_back(round_to_bytes(channel(tensor, i)));
    }
    weights.tensors[name + std::string(kScale)] = std::move(steps);
  }
  return weights;
}

Weights from_bytes(Weights weights, const std::string& where) {
  for (const auto& [name, tensor] : weights.tensors) {
    if (!name.ends_with(kScale)) continue;
    const std::string of = name.substr(0, name.size() - kScale.size());
    const auto found = weights.tensors.find(of);
    if (found == weights.tensors.end()) {
      throw DataError(where, "has '" + name + "' but no tensor '" + of + "'",
                      "write it with mms quantize");
    }
    multiply(found->second, of, tensor, where);
  }
  std::erase_if(weights.tensors, [](const auto& entry) { return entry.first.ends_with(kScale); });
  return weights;
}

}  // namespace mms
