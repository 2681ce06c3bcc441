#include "mms/segmentation/weights/weight_transfer.hpp"

#include <string>
#include <string_view>
#include <vector>

#include "mms/segmentation/weights/backbone_shapes.hpp"
#include "mms/segmentation/weights/weight_standardisation.hpp"

namespace mms {
namespace {

/// For the given convolutions of the first backbone.
void add_standardisation(const BackboneConfig& config, Weights& weights) {
  constexpr std::string_view kGamma = ".weight_gamma";
  LayerShapes layers;
  add_backbone(config, std::string(kFirstBackbone), 0, layers);
  for (const auto& [name, shape] : layers.shapes()) {
    if (!name.ends_with(kGamma) || weights.tensors.contains(name)) continue;
    const std::string conv = name.substr(0, name.size() - kGamma.size());
    if (weights.tensors.contains(conv + ".weight")) keep_weight(conv, weights);
  }
}

void copy_backbone(Weights& weights) {
  Weights second;
  for (const auto& [name, tensor] : weights.tensors) {
    if (name.starts_with(kSecondBackbone)) return;
    if (!name.starts_with(kFirstBackbone)) continue;
    second.tensors[std::string(kSecondBackbone) + name.substr(kFirstBackbone.size())] = tensor;
  }
  weights.tensors.merge(second.tensors);
}

/// The statistics of the towers for each level, where they are those of all levels.
void divide_statistics(const HeadConfig& config, Weights& weights) {
  const TensorShape of_all = {config.tower_channels};
  for (auto& [name, tensor] : weights.tensors) {
    const bool is_tower =
        name.starts_with("mask_head.kernel_convs.") || name.starts_with("mask_head.cls_convs.");
    const bool is_statistic = name.ends_with(".running_mean") || name.ends_with(".running_var");
    if (!is_tower || !is_statistic || tensor.shape != of_all) continue;
    const std::vector<float> values = tensor.values;
    tensor.shape.insert(tensor.shape.begin(), HeadConfig::kLevels);
    for (int level = 1; level < HeadConfig::kLevels; ++level) {
      tensor.values.insert(tensor.values.end(), values.begin(), values.end());
    }
  }
}

/// To the kernels of a head without one.
void add_window(const HeadConfig& config, Weights& weights) {
  const auto weight = weights.tensors.find("mask_head.conv_kernel.weight");
  const auto bias = weights.tensors.find("mask_head.conv_kernel.bias");
  if (weight == weights.tensors.end() || bias == weights.tensors.end()) return;
  const std::vector<std::int64_t> without_window = {config.kernel_channels};
  if (bias->second.shape != without_window || weight->second.shape.empty()) return;
  if (weight->second.shape.front() != config.kernel_channels) return;
  WeightTensor& kernels = weight->second;
  const std::size_t row = kernels.values.size() / static_cast<std::size_t>(kernels.shape.front());
  kernels.shape.front() = config.kernel_length();
  kernels.values.resize(row * static_cast<std::size_t>(config.kernel_length()), 0.0F);
  bias->second.shape.front() = config.kernel_length();
  bias->second.values.insert(bias->second.values.end(),
                             {kInitialWindowDecay, kInitialWindowDecay, 0.0F, 0.0F});
}

}  // namespace

Weights grown_to(const NetworkConfig& config, Weights weights) {
  add_standardisation(config.backbone, weights);
  if (config.neck.recursive) copy_backbone(weights);
  if (config.head.level_norms) divide_statistics(config.head, weights);
  if (config.head.window) add_window(config.head, weights);
  return weights;
}

}  // namespace mms
