#pragma once

#include <span>
#include <string>

#include "mms/core/weights.hpp"

namespace mms {

/// Adaptive weight standardization of DetectoRS (mmcv ConvAWS2d): per output channel (w - mean) /
/// sqrt(variance + 1e-5) * gamma + beta, with the mean and unbiased variance of its weights.
/// @param weight  consecutive output channels, as many as gamma and beta have numbers
void standardise(std::span<float> weight, std::span<const float> gamma,
                 std::span<const float> beta);

/// Sets gamma and beta, (out, 1, 1, 1), of the convolution NAME so that its effective weight is
/// NAME.weight.
void keep_weight(const std::string& name, Weights& weights);

/// Replaces standardized weights by the effective ones, with gamma and beta from `keep_weight`: the
/// network computes the same.
void settle_standardisation(Weights& weights);

}  // namespace mms
