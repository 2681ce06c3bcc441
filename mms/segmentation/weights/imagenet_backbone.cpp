#include "mms/segmentation/weights/imagenet_backbone.hpp"

#include <array>
#include <string_view>

#include "mms/core/error.hpp"
#include "mms/segmentation/weights/backbone_shapes.hpp"
#include "mms/segmentation/weights/checkpoint_names.hpp"
#include "mms/segmentation/weights/weight_transfer.hpp"

namespace mms {
namespace {

constexpr std::string_view kMean = ".running_mean";
constexpr std::array<std::string_view, 4> kNormParts = {".weight", ".bias", kMean, ".running_var"};
constexpr double kVarianceFloor = 1e-5;  // of batch norm

/// The convolution before a batch norm: bn2 -> conv2, downsample.1 -> downsample.0.
std::string conv_before(std::string norm) {
  const std::string_view skip = "downsample.1";
  if (norm.ends_with(skip)) return norm.replace(norm.size() - 1, 1, "0");
  return norm.replace(norm.rfind("bn"), 2, "conv");
}

WeightTensor constant(std::int64_t channels, double value) {
  return {{channels},
          std::vector<float>(static_cast<std::size_t>(channels), static_cast<float>(value))};
}

/// Copies the convolutions with their batch norms.
class BackboneTransfer {
 public:
  BackboneTransfer(const Weights& given, const BackboneConfig& config) {
    LayerShapes layers;
    add_backbone(config, "", 0, layers);
    wanted_ = layers.shapes();
    for (const auto& [published, tensor] : given.tensors) {
      if (const auto name = network_name(published)) given_[*name] = &tensor;
    }
  }

  /// With names without a prefix.
  ImagenetBackbone run() {
    for (const auto& [name, shape] : wanted_) {
      if (!name.ends_with(kMean)) continue;
      const std::string norm = name.substr(0, name.size() - kMean.size());
      const std::string conv = conv_before(norm);
      if (find(conv + ".weight") == nullptr || !(take_norm(norm) || unfold_norm(conv, norm))) {
        skip(conv, norm);
      } else {
        take_conv(conv);
      }
    }
    return std::move(result_);
  }

 private:
  /// A tensor if it has the expected shape.
  const WeightTensor* find(const std::string& name) const { return find(name, wanted_.at(name)); }

  const WeightTensor* find(const std::string& name, const TensorShape& shape) const {
    const auto found = given_.find(name);
    if (found == given_.end() || found->second->shape != shape) return nullptr;
    return found->second->values.size() == value_count(shape) ? found->second : nullptr;
  }

  bool take_norm(const std::string& norm) {
    std::array<const WeightTensor*, kNormParts.size()> parts{};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      parts[i] = find(norm + std::string(kNormParts[i]));
      if (parts[i] == nullptr) return false;
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      taken(norm + std::string(kNormParts[i])) = *parts[i];
    }
    return true;
  }

  bool unfold_norm(const std::string& conv, const std::string& norm) {
    const TensorShape& shape = wanted_.at(norm + ".bias");
    const WeightTensor* bias = find(conv + ".bias", shape);
    if (bias == nullptr) return false;
    taken(norm + ".weight") = constant(shape[0], 1.0);
    taken(norm + ".bias") = *bias;
    taken(norm + ".running_mean") = constant(shape[0], 0.0);
    taken(norm + ".running_var") = constant(shape[0], 1.0 - kVarianceFloor);
    return true;
  }

  void take_conv(const std::string& conv) { taken(conv + ".weight") = *find(conv + ".weight"); }

  void skip(const std::string& conv, const std::string& norm) {
    result_.left_out.push_back(conv + ".weight");
    for (const std::string_view part : kNormParts) {
      result_.left_out.push_back(norm + std::string(part));
    }
  }

  WeightTensor& taken(const std::string& name) { return result_.weights.tensors[name]; }

  TensorShapes wanted_;
  std::map<std::string, const WeightTensor*> given_;
  ImagenetBackbone result_;
};

}  // namespace

ImagenetBackbone imagenet_backbone(const Weights& torchvision, const NetworkConfig& config,
                                   const std::string& where) {
  const ImagenetBackbone plain = BackboneTransfer(torchvision, config.backbone).run();
  if (plain.weights.tensors.empty()) {
    throw DataError(where,
                    "has no layer of a ResNet-" + std::to_string(config.backbone.depth) +
                        " for this network: neither conv1.weight (64, 3, 7, 7) nor any other",
                    "expected torchvision's names");
  }
  ImagenetBackbone result;
  for (const auto& [name, tensor] : plain.weights.tensors) {
    result.weights.tensors[std::string(kFirstBackbone) + name] = tensor;
  }
  for (const std::string& name : plain.left_out) {
    result.left_out.push_back(std::string(kFirstBackbone) + name);
  }
  result.weights = grown_to(config, std::move(result.weights));
  return result;
}

}  // namespace mms
