#include "mms/segmentation/weights/backbone_shapes.hpp"

#include <algorithm>

namespace mms {
namespace {

constexpr std::int64_t kStemChannels = 64;
constexpr std::int64_t kExpansion = 4;        // of a bottleneck's last convolution
constexpr std::int64_t kOffsetChannels = 18;  // two coordinates for each of 3 x 3 taps

const ResnetLayout& layout_of(const BackboneConfig& config) {
  const auto& layouts = resnet_layouts();
  const auto found = std::ranges::find(layouts, config.depth, &ResnetLayout::depth);
  return found == layouts.end() ? layouts.back() : *found;
}

/// Channels inside the blocks of the four stages.
std::array<std::int64_t, 4> planes_of(const BackboneConfig& config) {
  return {64, 128, 256, config.last_planes};
}

class BackboneWalk {
 public:
  BackboneWalk(const BackboneConfig& config, std::int64_t feedback, LayerShapes& layers)
      : config_(config), layout_(layout_of(config)), feedback_(feedback), layers_(layers) {}

  void walk(const std::string& prefix) {
    conv(prefix + "conv1", kStemChannels, 3, 7);
    layers_.batch_norm(prefix + "bn1", kStemChannels);
    std::int64_t in = kStemChannels;
    for (std::size_t i = 0; i < layout_.blocks.size(); ++i) {
      stage(prefix + "layer" + std::to_string(i + 1) + ".", i, in);
      in = backbone_channels(config_)[i];
    }
  }

 private:
  void stage(const std::string& prefix, std::size_t index, std::int64_t in) {
    const std::int64_t planes = planes_of(config_)[index];
    const std::int64_t out = backbone_channels(config_)[index];
    const bool halves = index > 0;
    for (int i = 0; i < layout_.blocks[index]; ++i) {
      const std::string name = prefix + std::to_string(i) + ".";
      block(name, i == 0 ? in : out, planes, out, halves);
      if (i > 0) continue;
      if (halves || in != out) {
        conv(name + "downsample.0", out, in, 1);
        layers_.batch_norm(name + "downsample.1", out);
      }
      if (halves && feedback_ > 0) layers_.biased_conv(name + "rfp_conv", out, feedback_, 1);
    }
  }

  void block(const std::string& name, std::int64_t in, std::int64_t planes, std::int64_t out,
             bool switchable) {
    conv(name + "conv1", planes, in, layout_.bottleneck ? 1 : 3);
    layers_.batch_norm(name + "bn1", planes);
    conv(name + "conv2", planes, planes, 3);
    if (switchable && config_.sac != SacMode::kNone) add_switch(name + "conv2", planes);
    layers_.batch_norm(name + "bn2", planes);
    if (!layout_.bottleneck) return;
    conv(name + "conv3", out, planes, 1);
    layers_.batch_norm(name + "bn3", out);
  }

  /// All convolutions have standardized weights if some are switchable.
  void conv(const std::string& name, std::int64_t out, std::int64_t in, std::int64_t side) {
    layers_.conv(name, out, in, side);
    if (config_.sac == SacMode::kNone) return;
    layers_.add(name + ".weight_gamma", {out, 1, 1, 1});
    layers_.add(name + ".weight_beta", {out, 1, 1, 1});
  }

  /// Tensors of a switchable convolution besides its standardized weight.
  void add_switch(const std::string& name, std::int64_t planes) {
    layers_.add(name + ".weight_diff", {planes, planes, 3, 3});
    layers_.biased_conv(name + ".switch", 1, planes, 1);
    layers_.biased_conv(name + ".pre_context", planes, planes, 1);
    layers_.biased_conv(name + ".post_context", planes, planes, 1);
    if (config_.sac != SacMode::kDeformable) return;
    layers_.biased_conv(name + ".offset_s", kOffsetChannels, planes, 3);
    layers_.biased_conv(name + ".offset_l", kOffsetChannels, planes, 3);
  }

  const BackboneConfig& config_;
  const ResnetLayout& layout_;
  std::int64_t feedback_;
  LayerShapes& layers_;
};

}  // namespace

const std::array<ResnetLayout, 3>& resnet_layouts() {
  static constexpr std::array<ResnetLayout, 3> kLayouts = {
      {{18, {2, 2, 2, 2}, false}, {34, {3, 4, 6, 3}, false}, {50, {3, 4, 6, 3}, true}}};
  return kLayouts;
}

void add_backbone(const BackboneConfig& config, const std::string& prefix, std::int64_t feedback,
                  LayerShapes& layers) {
  BackboneWalk(config, feedback, layers).walk(prefix);
}

std::array<std::int64_t, 4> backbone_channels(const BackboneConfig& config) {
  std::array<std::int64_t, 4> channels = planes_of(config);
  if (!layout_of(config).bottleneck) return channels;
  for (std::int64_t& count : channels) count *= kExpansion;
  return channels;
}

}  // namespace mms
