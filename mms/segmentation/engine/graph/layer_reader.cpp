#include "mms/segmentation/engine/graph/layer_reader.hpp"

#include <cmath>
#include <string_view>

#include "mms/segmentation/weights/weight_standardisation.hpp"

namespace mms::engine {
namespace {

constexpr double kNormFloor = 1e-5;  // added to batch norm's variance
constexpr int kLargeDilation = 3;
constexpr std::string_view kLarge = ".large";

void take_in(ConvLayer& layer, const ChannelAffine& norm) {
  const auto count = static_cast<std::size_t>(layer.inputs_per_output());
  for (std::size_t o = 0; o < norm.scale.size(); ++o) {
    for (std::size_t i = 0; i < count; ++i) layer.weight[o * count + i] *= norm.scale[o];
    layer.bias[o] = layer.bias[o] * norm.scale[o] + norm.shift[o];
  }
}

}  // namespace

std::string weight_name(const std::string& layer) {
  if (!layer.ends_with(kLarge)) return layer + ".weight";
  return layer.substr(0, layer.size() - kLarge.size()) + ".weight_diff";
}

const std::vector<float>& LayerReader::values(const std::string& name) const {
  return weights_.tensors.at(name).values;
}

ChannelAffine LayerReader::batch_norm(const std::string& name, std::size_t level) const {
  const std::vector<float>& gamma = values(name + ".weight");
  const std::vector<float>& beta = values(name + ".bias");
  const std::vector<float>& mean = values(name + ".running_mean");
  const std::vector<float>& variance = values(name + ".running_var");
  const std::size_t first = mean.size() > gamma.size() ? level * gamma.size() : 0;
  ChannelAffine affine;
  for (std::size_t i = 0; i < gamma.size(); ++i) {
    const double scale = static_cast<double>(gamma[i]) /
                         std::sqrt(static_cast<double>(variance[first + i]) + kNormFloor);
    affine.scale.push_back(static_cast<float>(scale));
    affine.shift.push_back(static_cast<float>(static_cast<double>(beta[i]) -
                                              static_cast<double>(mean[first + i]) * scale));
  }
  return affine;
}

ConvLayer LayerReader::unbiased(const std::string& name, const ConvShape& shape) {
  WeightTensor& tensor = weights_.tensors.at(name + ".weight");
  ConvLayer layer{.name = name,
                  .in = static_cast<int>(tensor.shape[1]),
                  .out = static_cast<int>(tensor.shape[0]),
                  .kernel = static_cast<int>(tensor.shape[2]),
                  .stride = shape.stride,
                  .dilation = shape.dilation,
                  .relu = shape.relu,
                  .weight = std::move(tensor.values)};
  layer.bias.assign(static_cast<std::size_t>(layer.out), 0.0F);
  return layer;
}

void LayerReader::standardise(ConvLayer& layer) const {
  mms::standardise(layer.weight, values(layer.name + ".weight_gamma"),
                   values(layer.name + ".weight_beta"));
}

ConvLayerPtr LayerReader::known(const std::string& key) const {
  const auto found = layers_.find(key);
  return found == layers_.end() ? nullptr : found->second;
}

ConvLayerPtr LayerReader::kept(const std::string& key, ConvLayer layer) {
  return layers_[key] = std::make_shared<const ConvLayer>(std::move(layer));
}

ConvLayerPtr LayerReader::backbone_conv(const std::string& name, const std::string& norm,
                                        const ConvShape& shape) {
  if (ConvLayerPtr layer = known(name)) return layer;
  ConvLayer layer = unbiased(name, shape);
  if (has(name + ".weight_gamma")) standardise(layer);
  take_in(layer, batch_norm(norm));
  return kept(name, std::move(layer));
}

ConvLayerPtr LayerReader::switchable_small(const std::string& name, int stride) {
  if (ConvLayerPtr layer = known(name)) return layer;
  ConvLayer layer = unbiased(name, {.stride = stride});
  standardise(layer);
  return kept(name, std::move(layer));
}

ConvLayerPtr LayerReader::switchable_large(const std::string& name, int stride) {
  const std::string key = name + std::string(kLarge);
  if (ConvLayerPtr layer = known(key)) return layer;
  ConvLayer layer = *switchable_small(name, stride);
  layer.name = key;
  layer.dilation = kLargeDilation;
  const std::vector<float>& difference = values(name + ".weight_diff");
  for (std::size_t i = 0; i < difference.size(); ++i) layer.weight[i] += difference[i];
  return kept(key, std::move(layer));
}

ConvLayerPtr LayerReader::biased_conv(const std::string& name, const ConvShape& shape) {
  if (ConvLayerPtr layer = known(name)) return layer;
  ConvLayer layer = unbiased(name, shape);
  layer.bias = values(name + ".bias");
  return kept(name, std::move(layer));
}

ConvLayerPtr LayerReader::head_unit(const std::string& name, std::size_t level) {
  const bool has_levels = weights_.tensors.at(name + ".bn.running_mean").shape.size() > 1;
  const std::string key = has_levels ? name + " " + std::to_string(level) : name;
  if (ConvLayerPtr layer = known(key)) return layer;
  ConvLayer layer = *bare_unit(name);
  layer.relu = true;
  take_in(layer, batch_norm(name + ".bn", level));
  return kept(key, std::move(layer));
}

ConvLayerPtr LayerReader::bare_unit(const std::string& name) {
  const std::string key = name + ".conv";
  if (ConvLayerPtr layer = known(key)) return layer;
  return kept(key, unbiased(key, {}));
}

}  // namespace mms::engine
