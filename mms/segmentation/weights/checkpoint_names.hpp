#pragma once

#include <optional>
#include <string>

namespace mms {

/// The network's name of a published tensor: MMDetection's unchanged, WXinlong/SOLO's and
/// AdelaiDet's (with detectron2's backbone) converted, without prefixes of checkpoints
/// ("state_dict.", "model.", "module."). Unknown names are unchanged. nullopt for batch norm's
/// counters `num_batches_tracked`, which are not needed.
std::optional<std::string> network_name(std::string published);

/// Whether a published name is that of detectron2's backbone. Its ResNets use BGR with a standard
/// deviation of 1, and its ResNet-50 has the stride in the first 1x1 convolution of a block.
bool is_detectron_backbone(const std::string& published);

}  // namespace mms
