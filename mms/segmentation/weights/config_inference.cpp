#include "mms/segmentation/weights/config_inference.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

#include "mms/core/error.hpp"
#include "mms/segmentation/weights/backbone_shapes.hpp"

namespace mms {
namespace {

constexpr int kLightTower = 256;  // widest tower of the light networks

/// Finds the network's parameters in the tensors.
class TensorFacts {
 public:
  TensorFacts(const TensorShapes& tensors, const std::string& where)
      : tensors_(tensors), where_(where) {}

  bool has(const std::string& name) const { return tensors_.contains(name); }

  bool has_any(const std::string& prefix) const {
    const auto found = tensors_.lower_bound(prefix);
    return found != tensors_.end() && found->first.starts_with(prefix);
  }

  /// Output channels of a convolution.
  int channels(const std::string& name) const {
    const auto found = tensors_.find(name + ".weight");
    if (found == tensors_.end()) {
      throw DataError(where_, "is not a SOLOv2 network: missing tensor '" + name + ".weight'",
                      "supported: checkpoints of MMDetection, WXinlong/SOLO and AdelaiDet");
    }
    constexpr std::size_t kSides = 4;
    const TensorShape& shape = found->second;
    if (shape.size() != kSides || shape[0] > std::numeric_limits<int>::max()) {
      throw DataError(where_, "tensor '" + found->first + "' has shape " + shape_text(shape) +
                                  ", a convolution's (out, in, height, expected width)");
    }
    return static_cast<int>(shape[0]);
  }

  /// One more than the largest N of the names "prefixN.".
  int count(const std::string& prefix) const {
    constexpr int kMaxIndex = 1000;
    int count = 0;
    for (auto it = tensors_.lower_bound(prefix); it != tensors_.end(); ++it) {
      const std::string& name = it->first;
      if (!name.starts_with(prefix)) break;
      int number = 0;
      const char* digits = name.data() + prefix.size();
      const auto [end, fault] = std::from_chars(digits, name.data() + name.size(), number);
      if (fault == std::errc() && number < kMaxIndex) count = std::max(count, number + 1);
    }
    return count;
  }

 private:
  const TensorShapes& tensors_;
  const std::string& where_;
};

int infer_depth(const TensorFacts& facts, const std::string& where) {
  ResnetLayout found;
  std::string blocks;
  for (std::size_t i = 0; i < found.blocks.size(); ++i) {
    found.blocks[i] = facts.count("backbone.layer" + std::to_string(i + 1) + ".");
    blocks += (i == 0 ? "" : ", ") + std::to_string(found.blocks[i]);
  }
  found.bottleneck = facts.has_any("backbone.layer1.0.conv3.");
  for (const ResnetLayout& known : resnet_layouts()) {
    if (known.blocks == found.blocks && known.bottleneck == found.bottleneck) return known.depth;
  }
  throw DataError(where, "its backbone has stages of " + blocks +
                             (found.bottleneck ? " bottleneck" : " plain") +
                             " blocks, allowed: ResNet-18 (2, 2, 2, 2 plain), ResNet-34 (3, 4, 6, "
                             "3 plain) and ResNet-50 (3, 4, 6, 3 bottleneck)");
}

SacMode infer_sac(const TensorFacts& facts) {
  const std::string conv = "backbone.layer2.0.conv2";
  if (!facts.has(conv + ".switch.weight")) return SacMode::kNone;
  return facts.has(conv + ".offset_s.weight") ? SacMode::kDeformable : SacMode::kPlain;
}

NetworkVariant variant_of(bool recursive, bool switchable) {
  if (recursive) return switchable ? NetworkVariant::kDetectors : NetworkVariant::kRfp;
  return switchable ? NetworkVariant::kSac : NetworkVariant::kSolov2;
}

void infer_head(const TensorFacts& facts, HeadConfig& head) {
  head.tower_channels = facts.channels("mask_head.kernel_convs.0.conv");
  head.tower_depth = facts.count("mask_head.kernel_convs.");
  head.shared_tower = !facts.has_any("mask_head.cls_convs.");
  head.kernel_channels = facts.channels("mask_head.mask_feature_head.conv_pred.conv");
  head.window =
      facts.channels("mask_head.conv_kernel") == head.kernel_channels + HeadConfig::kWindowTerms;
  head.mask_channels = facts.channels("mask_head.mask_feature_head.convs_all_levels.0.conv0.conv");
  head.norm = facts.has("mask_head.kernel_convs.0.bn.weight") ? HeadNorm::kBatch : HeadNorm::kGroup;
}

/// Checks the parameters against the ranges of the settings.
class RangeCheck final : public ConfigVisitor {
 public:
  explicit RangeCheck(const std::string& where) : where_(where) {}

  void integer(const FieldInfo& info, int& value, Range range) override {
    if (value >= range.min && value <= range.max) return;
    throw DataError(where_, "its tensors result in a network whose " + std::string(info.key) +
                                " is " + std::to_string(value) +
                                ", allowed: " + std::to_string(static_cast<int>(range.min)) +
                                " to " + std::to_string(static_cast<int>(range.max)));
  }
  void number(const FieldInfo&, double&, Range) override {}
  void boolean(const FieldInfo&, bool&) override {}
  void choice(const FieldInfo&, int&, std::span<const std::string_view>) override {}
  void text(const FieldInfo&, std::string&) override {}

 protected:
  void begin_group(const FieldInfo&) override {}
  void end_group() override {}

 private:
  const std::string& where_;
};

}  // namespace

NetworkConfig infer_config(const TensorShapes& tensors, const std::string& where) {
  const TensorFacts facts(tensors, where);
  const bool light = facts.channels("mask_head.kernel_convs.0.conv") <= kLightTower;
  const SacMode sac = infer_sac(facts);
  const bool recursive = facts.has_any("neck.rfp_modules.");
  NetworkConfig config = NetworkConfig::preset(light ? NetworkSize::kR18 : NetworkSize::kR50,
                                               variant_of(recursive, sac != SacMode::kNone));
  config.backbone.depth = infer_depth(facts, where);
  config.backbone.last_planes = facts.channels("backbone.layer4.0.conv1");
  config.backbone.sac = sac;
  config.size = config.backbone.depth < 50 ? NetworkSize::kR18 : NetworkSize::kR50;
  config.neck.channels = facts.channels("neck.lateral_convs.0.conv");
  config.classes = facts.channels("mask_head.conv_cls");
  infer_head(facts, config.head);
  RangeCheck check(where);
  config.visit(check);
  return config;
}

}  // namespace mms
