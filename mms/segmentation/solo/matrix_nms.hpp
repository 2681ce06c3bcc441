#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace mms {

/// A binary mask as bits, with its number of pixels.
struct BitMask {
  std::vector<std::uint64_t> words;
  int area = 0;
};

/// Bits of the values above `threshold`.
BitMask bit_mask(std::span<const float> values, float threshold);
inline BitMask bit_mask(const std::vector<float>& values, float threshold) {
  return bit_mask(std::span<const float>(values), threshold);
}

/// A mask that competes with others of its category.
struct NmsCandidate {
  int category = 0;
  float score = 0.0F;
  BitMask mask;
};

/// Matrix NMS of SOLOv2 with the Gaussian kernel: factors on the scores for overlap with better
/// masks of the same category, decay_j = min over i < j of exp(-sigma (iou_ij^2 - c_i^2)), with c_i
/// the largest overlap of i with a better one.
/// @param candidates  in descending order of score
std::vector<float> matrix_nms(const std::vector<NmsCandidate>& candidates, float sigma = 2.0F);

}  // namespace mms
