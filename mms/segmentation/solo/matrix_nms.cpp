#include "mms/segmentation/solo/matrix_nms.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mms {
namespace {

constexpr std::size_t kWordBits = 64;

/// Number of pixels in both of two masks of one size.
int common_area(const BitMask& a, const BitMask& b) {
  int area = 0;
  for (std::size_t i = 0; i < a.words.size(); ++i) area += std::popcount(a.words[i] & b.words[i]);
  return area;
}

float overlap(const NmsCandidate& a, const NmsCandidate& b) {
  if (a.category != b.category) return 0.0F;
  const int common = common_area(a.mask, b.mask);
  const int united = a.mask.area + b.mask.area - common;
  return united == 0 ? 0.0F : static_cast<float>(common) / static_cast<float>(united);
}

/// At most 64 values as bits, the first one lowest. A span of fixed length is vectorized.
template <std::size_t kLength>
std::uint64_t word_of(std::span<const float, kLength> values, float threshold) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    word |= static_cast<std::uint64_t>(values[i] > threshold ? 1 : 0) << i;
  }
  return word;
}

}  // namespace

BitMask bit_mask(std::span<const float> values, float threshold) {
  BitMask mask;
  mask.words.reserve((values.size() + kWordBits - 1) / kWordBits);
  for (; values.size() >= kWordBits; values = values.subspan(kWordBits)) {
    mask.words.push_back(word_of(values.first<kWordBits>(), threshold));
  }
  if (!values.empty()) mask.words.push_back(word_of(values, threshold));
  for (const std::uint64_t word : mask.words) mask.area += std::popcount(word);
  return mask;
}

std::vector<float> matrix_nms(const std::vector<NmsCandidate>& candidates, float sigma) {
  const std::size_t count = candidates.size();
  std::vector<float> decay(count, 1.0F);
  std::vector<float> compensation(count, 0.0F);  // c_i
  for (std::size_t j = 1; j < count; ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const float iou = overlap(candidates[i], candidates[j]);
      const float c = compensation[i];
      decay[j] = std::min(decay[j], std::exp(-sigma * (iou * iou - c * c)));
      compensation[j] = std::max(compensation[j], iou);
    }
  }
  std::vector<float> scores(count);
  for (std::size_t i = 0; i < count; ++i) scores[i] = candidates[i].score * decay[i];
  return scores;
}

}  // namespace mms
