#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "mms/segmentation/solo/matrix_nms.hpp"

namespace mms {

/// Logistic function.
inline float sigmoid(float logit) {
  return 1.0F / (1.0F + std::exp(-logit));
}

/// The probabilities of a mask's pixels.
std::vector<float> probabilities(std::span<const float> logits);

/// Sum of the probabilities of the pixels in `mask`, whose bits are those of the positive logits.
float probability_sum(std::span<const float> logits, const BitMask& mask);

}  // namespace mms
