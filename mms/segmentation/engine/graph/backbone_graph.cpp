#include "mms/segmentation/engine/graph/backbone_graph.hpp"

#include <vector>

namespace mms::engine {
namespace {

constexpr int kSwitchBox = 5;  // [px]: SAC's switch uses the mean of this many pixels

int blocks_of(int depth, int stage) {
  constexpr std::array<int, kBackboneStages> kDeep = {3, 4, 6, 3};
  return depth == 18 ? 2 : kDeep[static_cast<std::size_t>(stage)];
}

/// A residual block, plain (two 3x3) or bottleneck (1x1, 3x3, 1x1).
class ResidualBlock {
 public:
  ResidualBlock(GraphBuilder& graph, LayerReader& layers, const BackboneConfig& config,
                std::string name, int stride)
      : graph_(graph),
        layers_(layers),
        name_(std::move(name)),
        stride_(stride),
        bottleneck_(config.depth >= 50) {}

  ValueId add(ValueId x, ValueId feedback) {
    ValueId skip = x;
    if (layers_.has(name_ + ".downsample.0.weight")) {
      skip = graph_.convolution(layers_.backbone_conv(name_ + ".downsample.0",
                                                      name_ + ".downsample.1", {.stride = stride_}),
                                x);
    }
    if (feedback != GraphBuilder::kNone) {
      skip = graph_.convolution(layers_.biased_conv(name_ + ".rfp_conv"), feedback, skip);
    }
    const ValueId y = convolution(1, bottleneck_ ? 1 : stride_, x, GraphBuilder::kNone);
    const int stride = bottleneck_ ? stride_ : 1;
    if (bottleneck_) return convolution(3, 1, second(stride, y, GraphBuilder::kNone), skip);
    return second(stride, y, skip);
  }

 private:
  ValueId convolution(int number, int stride, ValueId x, ValueId residual) {
    const std::string n = std::to_string(number);
    const auto layer = layers_.backbone_conv(name_ + ".conv" + n, name_ + ".bn" + n,
                                             {.stride = stride, .relu = true});
    return graph_.convolution(layer, x, residual);
  }

  /// The second convolution, switchable atrous if the network has SAC.
  ValueId second(int stride, ValueId x, ValueId residual) {
    if (!layers_.has(name_ + ".conv2.switch.weight")) return convolution(2, stride, x, residual);
    const std::string conv = name_ + ".conv2";
    const ValueId input = context(conv + ".pre_context", x);
    const Gate gate = {.weight = layers_.values(conv + ".switch.weight"),
                       .bias = layers_.values(conv + ".switch.bias").front(),
                       .box = kSwitchBox,
                       .stride = stride};
    const ValueId mix = graph_.gate(gate, input);
    const ValueId small = graph_.convolution(layers_.switchable_small(conv, stride), input);
    const ValueId large = graph_.convolution(layers_.switchable_large(conv, stride), input);
    ChannelAffine norm = layers_.batch_norm(name_ + ".bn2");
    GlobalContext after = {.layer = layers_.biased_conv(conv + ".post_context"),
                           .scale = std::move(norm.scale),
                           .shift = std::move(norm.shift),
                           .relu = true};
    return graph_.global_context(std::move(after), graph_.blending(small, large, mix), residual);
  }

  ValueId context(const std::string& name, ValueId x) {
    const ConvLayerPtr layer = layers_.biased_conv(name);
    const auto channels = static_cast<std::size_t>(layer->out);
    return graph_.global_context({.layer = layer,
                                  .scale = std::vector<float>(channels, 1.0F),
                                  .shift = std::vector<float>(channels, 0.0F)},
                                 x);
  }

  GraphBuilder& graph_;
  LayerReader& layers_;
  std::string name_;
  int stride_;
  bool bottleneck_;
};

}  // namespace

BackboneFeatures add_backbone(GraphBuilder& graph, LayerReader& layers,
                              const BackboneConfig& config, const std::string& name,
                              const BackboneFeedback& feedback) {
  const auto stem =
      layers.backbone_conv(name + ".conv1", name + ".bn1", {.stride = 2, .relu = true});
  ValueId x = graph.max_pooling({.kernel = 3, .stride = 2, .padding = 1},
                                graph.convolution(stem, graph.input()));
  BackboneFeatures features{};
  for (int stage = 0; stage < kBackboneStages; ++stage) {
    for (int block = 0; block < blocks_of(config.depth, stage); ++block) {
      const bool first = block == 0 && stage > 0;
      const std::string block_name =
          name + ".layer" + std::to_string(stage + 1) + "." + std::to_string(block);
      const ValueId fed = first && feedback ? (*feedback)[static_cast<std::size_t>(stage - 1)]
                                            : GraphBuilder::kNone;
      x = ResidualBlock(graph, layers, config, block_name, first ? 2 : 1).add(x, fed);
    }
    features[static_cast<std::size_t>(stage)] = x;
  }
  return features;
}

}  // namespace mms::engine
