#pragma once

#include "mms/core/weights.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// Weights of a network extended by switchable atrous convolution or a recursive pyramid, which
/// initially computes the same: for standardized weights, gamma and beta are their standard
/// deviation and mean (DetectoRS, mmcv ConvAWS2d), and a second backbone is a copy of the first.
/// Tensors that start at zero (switch, context, fusion) are not included; given tensors are
/// unchanged.
Weights grown_to(const NetworkConfig& config, Weights weights);

}  // namespace mms
