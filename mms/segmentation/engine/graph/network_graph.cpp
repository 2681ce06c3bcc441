#include "mms/segmentation/engine/graph/network_graph.hpp"

#include <algorithm>
#include <numeric>

#include "mms/segmentation/engine/graph/backbone_graph.hpp"

namespace mms::engine {
namespace {

using Pyramid = std::array<ValueId, HeadConfig::kLevels>;

constexpr int kGroups = 32;

class NetworkGraph {
 public:
  NetworkGraph(const NetworkConfig& config, LayerReader& layers, int height, int width)
      : config_(config), layers_(layers), graph_({height, width, 3}) {}

  Graph build() {
    Pyramid pyramid = feature_pyramid(backbone("backbone", {}));
    if (config_.neck.recursive) pyramid = second_step(pyramid);
    GraphOutputs outputs;
    outputs.mask_features = mask_features(pyramid);
    const Pyramid levels = head_levels(pyramid);
    for (std::size_t i = 0; i < levels.size(); ++i) add_level(levels[i], i, outputs);
    return graph_.finish(outputs);
  }

 private:
  BackboneFeatures backbone(const std::string& name, const BackboneFeedback& feedback) {
    return add_backbone(graph_, layers_, config_.backbone, name, feedback);
  }

  Pyramid feature_pyramid(const BackboneFeatures& features) {
    std::array<ValueId, kBackboneStages> merged{};
    for (std::size_t i = features.size(); i-- > 0;) {
      const auto layer = layers_.biased_conv("neck.lateral_convs." + std::to_string(i) + ".conv");
      merged[i] = graph_.convolution(layer, features[i]);
      if (i + 1 == features.size()) continue;
      const Shape& shape = graph_.shape(merged[i]);
      merged[i] = graph_.resized(false, merged[i + 1], shape.height, shape.width, merged[i]);
    }
    Pyramid pyramid{};
    for (std::size_t i = 0; i < merged.size(); ++i) {
      const auto layer = layers_.biased_conv("neck.fpn_convs." + std::to_string(i) + ".conv");
      pyramid[i] = graph_.convolution(layer, merged[i]);
    }
    pyramid[merged.size()] = graph_.max_pooling({.kernel = 1, .stride = 2}, pyramid[3]);
    return pyramid;
  }

  /// Atrous spatial pyramid pooling: the feedback of the pyramid.
  ValueId aspp(ValueId x) {
    const std::string name = "neck.rfp_aspp.aspp.";
    const auto branch = [&](int number, int dilation) {
      const ConvShape shape = {.dilation = dilation, .relu = true};
      return graph_.convolution(layers_.biased_conv(name + std::to_string(number), shape), x);
    };
    const std::vector<ValueId> parts = {
        branch(0, 1), branch(1, 3), branch(2, 6),
        graph_.global_branch(layers_.biased_conv(name + "3", {.relu = true}), x)};
    return graph_.concatenation(parts);
  }

  Pyramid second_step(const Pyramid& first) {
    const std::array feedback = {aspp(first[1]), aspp(first[2]), aspp(first[3])};
    const Pyramid again = feature_pyramid(backbone("neck.rfp_modules.0", feedback));
    Pyramid fused{};
    for (std::size_t i = 0; i < fused.size(); ++i) {
      const Gate gate = {.weight = layers_.values("neck.rfp_weight.weight"),
                         .bias = layers_.values("neck.rfp_weight.bias").front(),
                         .sigmoid = true};
      fused[i] = graph_.blending(again[i], first[i], graph_.gate(gate, again[i]));
    }
    return fused;
  }

  /// Convolution, norm, ReLU.
  ValueId head_unit(const std::string& name, ValueId x, std::size_t level = 0) {
    if (config_.head.norm == HeadNorm::kBatch) {
      return graph_.convolution(layers_.head_unit(name, level), x);
    }
    const ConvLayerPtr layer = layers_.bare_unit(name);
    return graph_.group_norm({.groups = std::gcd(kGroups, layer->out),
                              .gamma = layers_.values(name + ".gn.weight"),
                              .beta = layers_.values(name + ".gn.bias")},
                             graph_.convolution(layer, x));
  }

  /// x and y from -1 at the first pixel to 1 at the last.
  ValueId coordinates(int height, int width) {
    const auto at = [](int i, int count) {
      return count == 1 ? -1.0F
                        : -1.0F + 2.0F * static_cast<float>(i) / static_cast<float>(count - 1);
    };
    std::vector<float> values;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        values.push_back(at(x, width));
        values.push_back(at(y, height));
      }
    }
    return graph_.constant({height, width, 2}, std::move(values), "coordinates");
  }

  ValueId with_coordinates(ValueId x) {
    const Shape& shape = graph_.shape(x);
    return graph_.concatenation({x, coordinates(shape.height, shape.width)});
  }

  ValueId doubled(ValueId x, ValueId addend) {
    return graph_.resized(true, x, 2 * graph_.shape(x).height, 2 * graph_.shape(x).width, addend);
  }

  /// Mask features from P2 to P5, shared by all masks of an image.
  ValueId mask_features(const Pyramid& pyramid) {
    const std::string name = "mask_head.mask_feature_head.";
    constexpr int kInputs = 4;
    ValueId sum = GraphBuilder::kNone;
    for (int level = 0; level < kInputs; ++level) {
      ValueId x = pyramid[static_cast<std::size_t>(level)];
      if (level + 1 == kInputs) x = with_coordinates(x);
      const int units = std::max(1, level);
      for (int i = 0; i < units; ++i) {
        x = head_unit(
            name + "convs_all_levels." + std::to_string(level) + ".conv" + std::to_string(i), x);
        if (level > 0) x = doubled(x, i + 1 == units ? sum : GraphBuilder::kNone);
      }
      sum = x;
    }
    return head_unit(name + "conv_pred", sum);
  }

  /// The levels at strides 8, 8, 16, 32, 32.
  Pyramid head_levels(const Pyramid& p) {
    const auto like = [&](ValueId x, ValueId other) {
      return graph_.resized(true, x, graph_.shape(other).height, graph_.shape(other).width);
    };
    return {like(p[0], p[1]), p[1], p[2], p[3], like(p[4], p[3])};
  }

  ValueId tower(const std::string& name, ValueId x, std::size_t level) {
    for (int i = 0; i < config_.head.tower_depth; ++i) {
      x = head_unit(name + std::to_string(i), x, level);
    }
    return x;
  }

  void add_level(ValueId level, std::size_t i, GraphOutputs& outputs) {
    const int side = config_.head.grids()[i];
    const ValueId cells = graph_.resized(true, with_coordinates(level), side, side);
    const ValueId for_kernels = tower("mask_head.kernel_convs.", cells, i);
    const ValueId for_categories =
        config_.head.shared_tower
            ? for_kernels
            : tower("mask_head.cls_convs.", graph_.resized(true, level, side, side), i);
    outputs.kernels[i] =
        graph_.convolution(layers_.biased_conv("mask_head.conv_kernel"), for_kernels);
    outputs.categories[i] =
        graph_.convolution(layers_.biased_conv("mask_head.conv_cls"), for_categories);
  }

  const NetworkConfig& config_;
  LayerReader& layers_;
  GraphBuilder graph_;
};

}  // namespace

Graph network_graph(const NetworkConfig& config, LayerReader& layers, int height, int width) {
  return NetworkGraph(config, layers, height, width).build();
}

}  // namespace mms::engine
