#pragma once

#include <optional>
#include <string>

namespace mms {

/// The network's name of a tensor that a training framework published: MMDetection's as it is,
/// WXinlong/SOLO's and AdelaiDet's (on detectron2's backbone) translated, without what wraps whole
/// checkpoints ("state_dict.", "model.", "module."). Names of none of them come back unchanged.
/// Nothing for batch norm's counters `num_batches_tracked`, which no network needs.
std::optional<std::string> network_name(std::string published);

/// Whether a published name is of detectron2's backbone. Its ResNets take BGR with a deviation of
/// 1, and its ResNet-50 has the stride in the first 1x1 convolution of a block.
bool is_detectron_backbone(const std::string& published);

}  // namespace mms
