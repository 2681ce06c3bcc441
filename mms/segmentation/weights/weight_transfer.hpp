#pragma once

#include "mms/core/weights.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// Of a new window: the logit of a mask falls by 0.05 at one cell from the center, so that masks
/// hardly change at first.
constexpr float kInitialWindowDecay = -3.0F;

/// Weights of a network extended by switchable atrous convolution or a recursive pyramid, which
/// initially computes the same: for standardized weights, gamma and beta are their standard
/// deviation and mean (DetectoRS, mmcv ConvAWS2d), and a second backbone is a copy of the first.
/// A window is nearly neutral at first. Tensors that start at zero (switch, context, fusion) are
/// not included; other given tensors are unchanged.
Weights grown_to(const NetworkConfig& config, Weights weights);

}  // namespace mms
