#include "mms/segmentation/weights/weight_transfer.hpp"

#include <string>
#include <string_view>

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

}  // namespace

Weights grown_to(const NetworkConfig& config, Weights weights) {
  add_standardisation(config.backbone, weights);
  if (config.neck.recursive) copy_backbone(weights);
  return weights;
}

}  // namespace mms
