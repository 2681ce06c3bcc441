#pragma once

#include <string>
#include <vector>

#include "mms/core/weights.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// Weights that a network's backbones take from a classifier.
struct ImagenetBackbone {
  Weights weights;  ///< by the network's names, complete layers only
  std::vector<std::string>
      left_out;  ///< convolutions and batch norms of `backbone.` without weights
};

/// Initial weights from torchvision's ResNet trained on ImageNet, for both backbones of a recursive
/// network. A convolution and the following batch norm are copied together; if one of them is
/// missing or has another shape, both are skipped. Batch norm may be folded into convolutions with
/// a bias: it becomes a batch norm that only adds this bias. For standardized weights (SAC), gamma
/// and beta are set so that the effective weights are the given ones. Layers without a counterpart
/// (fc, SAC's switch, RFP) are not included.
/// @throws DataError at `where` if no layer fits.
ImagenetBackbone imagenet_backbone(const Weights& torchvision, const NetworkConfig& config,
                                   const std::string& where);

}  // namespace mms
