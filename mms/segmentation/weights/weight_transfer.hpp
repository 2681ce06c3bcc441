#pragma once

#include "mms/core/weights.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// Weights of a plainer network for one that has switchable atrous convolution or a recursive
/// pyramid besides, which computes the same with them until it is trained further: where weights
/// are standardised, gamma and beta are their own deviation and mean (DetectoRS, mmcv ConvAWS2d),
/// and a second backbone is a copy of the first. What starts at zero in such a network (switches,
/// contexts, fusion) is left to it; tensors that are given stay as they are.
Weights grown_to(const NetworkConfig& config, Weights weights);

}  // namespace mms
