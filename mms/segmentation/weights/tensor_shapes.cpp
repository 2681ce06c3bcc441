#include "mms/segmentation/weights/tensor_shapes.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/segmentation/weights/backbone_shapes.hpp"

namespace mms {
namespace {

constexpr std::int64_t kCoordinates = 2;  // channels appended to a map: x and y
constexpr int kLevels = 4;                // levels of the pyramid from the backbone

/// Feature pyramid, with additions of the second RFP step.
void add_neck(const NetworkConfig& config, LayerShapes& layers) {
  const std::int64_t channels = config.neck.channels;
  const auto inputs = backbone_channels(config.backbone);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::string number = std::to_string(i);
    layers.biased_conv("neck.lateral_convs." + number + ".conv", channels, inputs[i], 1);
    layers.biased_conv("neck.fpn_convs." + number + ".conv", channels, channels, 3);
  }
  if (!config.neck.recursive) return;
  add_backbone(config.backbone, std::string(kSecondBackbone), channels, layers);
  constexpr std::array<std::int64_t, 4> kSides = {1, 3, 3, 1};
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    const std::string name = "neck.rfp_aspp.aspp." + std::to_string(i);
    layers.biased_conv(name, channels / 4, channels, kSides[i]);
  }
  layers.biased_conv("neck.rfp_weight", 1, channels, 1);
}

/// Convolution without bias, with norm.
/// @param levels  with statistics of their own; 0: one for all
void add_unit(const std::string& name, std::int64_t out, std::int64_t in, std::int64_t side,
              HeadNorm norm, LayerShapes& layers, std::int64_t levels = 0) {
  layers.conv(name + ".conv", out, in, side);
  if (norm == HeadNorm::kGroup) {
    layers.group_norm(name + ".gn", out);
  } else {
    layers.batch_norm(name + ".bn", out, levels);
  }
}

void add_tower(const std::string& name, std::int64_t in, const HeadConfig& config,
               LayerShapes& layers) {
  for (int i = 0; i < config.tower_depth; ++i) {
    add_unit(name + "." + std::to_string(i), config.tower_channels,
             i == 0 ? in : config.tower_channels, 3, config.norm, layers,
             config.level_norms ? HeadConfig::kLevels : 0);
  }
}

/// Each level has one convolution before each upsampling, the first level one.
void add_mask_features(const std::string& name, std::int64_t in, const HeadConfig& config,
                       LayerShapes& layers) {
  for (int level = 0; level < kLevels; ++level) {
    std::int64_t from = level == kLevels - 1 ? in + kCoordinates : in;
    for (int i = 0; i < std::max(1, level); ++i) {
      const std::string unit = std::to_string(level) + ".conv" + std::to_string(i);
      add_unit(name + ".convs_all_levels." + unit, config.mask_channels, from, 3, config.norm,
               layers);
      from = config.mask_channels;
    }
  }
  add_unit(name + ".conv_pred", config.kernel_channels, config.mask_channels, 1, config.norm,
           layers);
}

void add_head(const NetworkConfig& network, LayerShapes& layers) {
  const HeadConfig& config = network.head;
  const std::int64_t in = network.neck.channels;
  add_tower("mask_head.kernel_convs", in + kCoordinates, config, layers);
  if (!config.shared_tower) add_tower("mask_head.cls_convs", in, config, layers);
  layers.biased_conv("mask_head.conv_cls", network.classes, config.tower_channels, 3);
  layers.biased_conv("mask_head.conv_kernel", config.kernel_length(), config.tower_channels, 3);
  add_mask_features("mask_head.mask_feature_head", in, config, layers);
}

}  // namespace

TensorShapes expected_tensors(const NetworkConfig& config) {
  LayerShapes layers;
  add_backbone(config.backbone, std::string(kFirstBackbone), 0, layers);
  add_neck(config, layers);
  add_head(config, layers);
  return layers.shapes();
}

void check_fitting(const Weights& weights, const TensorShapes& expected, const std::string& where) {
  for (const auto& [name, tensor] : weights.tensors) {
    const auto found = expected.find(name);
    if (found == expected.end()) {
      throw DataError(where, "has the tensor " + name + ", which its network does not have",
                      "the weights have another architecture");
    }
    if (tensor.shape != found->second) {
      throw DataError(where, "tensor " + name + " is " + shape_text(tensor.shape) +
                                 ", the network has " + shape_text(found->second));
    }
  }
}

void check_complete(const Weights& weights, const TensorShapes& expected,
                    const std::string& where) {
  for (const auto& [name, shape] : expected) {
    if (!weights.tensors.contains(name)) {
      throw DataError(where, "misses the tensor " + name, "the weights have another architecture");
    }
  }
  check_fitting(weights, expected, where);
}

}  // namespace mms
