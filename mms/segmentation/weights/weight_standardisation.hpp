#pragma once

#include <span>
#include <string>

#include "mms/core/weights.hpp"

namespace mms {

/// DetectoRS' adaptive weight standardisation (mmcv ConvAWS2d): the weights of each output channel,
/// (w - mean) / sqrt(variance + 1e-5) * gamma + beta with their own mean and unbiased variance.
/// @param weight  output channels one after the other, as many as gamma and beta have numbers
void standardise(std::span<float> weight, std::span<const float> gamma,
                 std::span<const float> beta);

/// Gives the convolution NAME the gamma and beta, (out, 1, 1, 1), with which it convolves with
/// NAME.weight as it is.
void keep_weight(const std::string& name, Weights& weights);

/// Replaces the weights that are standardised by those that are convolved with, which stay as they
/// are by `keep_weight`: the network computes the same.
void settle_standardisation(Weights& weights);

}  // namespace mms
