#include "mms/segmentation/solo/mask_logits.hpp"

#include <Eigen/Core>
#include <algorithm>

namespace mms {
namespace {

constexpr std::size_t kWordBits = 64;

using Values = Eigen::Map<const Eigen::ArrayXf>;

Values as_array(std::span<const float> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace

std::vector<float> probabilities(std::span<const float> logits) {
  std::vector<float> result(logits.size());
  Eigen::Map<Eigen::ArrayXf>(result.data(), as_array(logits).size()) =
      1.0F / (1.0F + (-as_array(logits)).exp());
  return result;
}

float probability_sum(std::span<const float> logits, const BitMask& mask) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < mask.words.size(); ++i) {
    if (mask.words[i] == 0) continue;  // most pixels are outside the mask
    const std::size_t first = i * kWordBits;
    const Values part = as_array(logits.subspan(first, std::min(kWordBits, logits.size() - first)));
    sum += (part > 0.0F).select(1.0F / (1.0F + (-part).exp()), 0.0F).sum();
  }
  return sum;
}

}  // namespace mms
