#include "mms/segmentation/weights/weight_standardisation.hpp"

#include <cmath>
#include <numeric>
#include <string_view>
#include <vector>

namespace mms {
namespace {

constexpr double kVarianceFloor = 1e-5;
constexpr std::string_view kGamma = ".weight_gamma";

struct Spread {
  double mean = 0.0;
  double deviation = 0.0;  ///< divisor
};

Spread spread_of(std::span<const float> values) {
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0.0;
  for (const float value : values) squares += std::pow(static_cast<double>(value) - mean, 2);
  return {mean, std::sqrt(squares / (count - 1.0) + kVarianceFloor)};
}

}  // namespace

void standardise(std::span<float> weight, std::span<const float> gamma,
                 std::span<const float> beta) {
  const std::size_t count = weight.size() / gamma.size();
  for (std::size_t o = 0; o < gamma.size(); ++o) {
    const std::span<float> channel = weight.subspan(o * count, count);
    const Spread spread = spread_of(channel);
    const double scale = static_cast<double>(gamma[o]) / spread.deviation;
    for (float& value : channel) {
      value = static_cast<float>((static_cast<double>(value) - spread.mean) * scale +
                                 static_cast<double>(beta[o]));
    }
  }
}

void keep_weight(const std::string& name, Weights& weights) {
  const WeightTensor& weight = weights.tensors.at(name + ".weight");
  const auto outputs = static_cast<std::size_t>(weight.shape.at(0));
  const std::size_t count = weight.values.size() / outputs;
  WeightTensor gamma{{weight.shape[0], 1, 1, 1}, {}};
  WeightTensor beta = gamma;
  for (std::size_t o = 0; o < outputs; ++o) {
    const Spread spread = spread_of({weight.values.data() + o * count, count});
    gamma.values.push_back(static_cast<float>(spread.deviation));
    beta.values.push_back(static_cast<float>(spread.mean));
  }
  weights.tensors[name + std::string(kGamma)] = std::move(gamma);
  weights.tensors[name + ".weight_beta"] = std::move(beta);
}

void settle_standardisation(Weights& weights) {
  std::vector<std::string> names;
  for (const auto& [tensor, values] : weights.tensors) {
    if (tensor.ends_with(kGamma)) names.push_back(tensor.substr(0, tensor.size() - kGamma.size()));
  }
  for (const std::string& name : names) {
    standardise(weights.tensors.at(name + ".weight").values,
                weights.tensors.at(name + std::string(kGamma)).values,
                weights.tensors.at(name + ".weight_beta").values);
    keep_weight(name, weights);
  }
}

}  // namespace mms
