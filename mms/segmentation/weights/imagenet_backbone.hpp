#pragma once

#include <string>
#include <vector>

#include "mms/core/weights.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// What a network's backbones take over from a classifier.
struct ImagenetBackbone {
  Weights weights;                    ///< by the network's names, complete layers only
  std::vector<std::string> left_out;  ///< convolutions and batch norms of `backbone.` without any
};

/// Initial weights from a ResNet that torchvision trained on ImageNet; both backbones get them when
/// the network looks twice. A convolution and the batch norm after it go together: where one of
/// them is missing or of another shape, both are left out. Batch norm may be folded into the
/// convolutions, which then have a bias: it comes back as one that only adds this bias. Where the
/// network standardises weights (SAC), mean and deviation are set so that the weights convolved
/// with are those given. What ImageNet knows nothing of (fc, SAC's switches, RFP) is no part of it.
/// @throws DataError at `where` when no layer fits.
ImagenetBackbone imagenet_backbone(const Weights& torchvision, const NetworkConfig& config,
                                   const std::string& where);

}  // namespace mms
