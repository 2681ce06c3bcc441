#pragma once

#include <array>
#include <string_view>

#include "mms/segmentation/solo/network_config.hpp"
#include "mms/segmentation/weights/layer_shapes.hpp"

namespace mms {

/// Prefixes of the tensor names of the first backbone and of the second one of a recursive pyramid.
inline constexpr std::string_view kFirstBackbone = "backbone.";
inline constexpr std::string_view kSecondBackbone = "neck.rfp_modules.0.";

/// Number and kind of the residual blocks of a ResNet's four stages.
struct ResnetLayout {
  int depth = 50;  ///< layers, as in ResNet-50
  std::array<int, 4> blocks{};
  bool bottleneck = false;  ///< 1x1, 3x3, 1x1 instead of two 3x3
};

/// Supported ResNets: 18, 34 and 50 layers.
const std::array<ResnetLayout, 3>& resnet_layouts();

/// Adds a backbone's tensors with `prefix`: torchvision's names, and DetectoRS' for SAC.
/// @param feedback  channels of the pyramid's feedback to stages 2 to 4; 0: none
void add_backbone(const BackboneConfig& config, const std::string& prefix, std::int64_t feedback,
                  LayerShapes& layers);

/// Channels of C2 to C5.
std::array<std::int64_t, 4> backbone_channels(const BackboneConfig& config);

}  // namespace mms
