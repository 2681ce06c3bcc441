#include "mms/segmentation/solo/mask_logits.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mms {
namespace {

/// Logits of `count` pixels, most of them far below 0 and in no mask.
std::vector<float> random_logits(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0.0F, 4.0F);
  std::vector<float> logits(count, -90.0F);  // exp(90) has no float32
  for (std::size_t i = count / 3; i < count / 2 + 1; ++i) logits[i] = normal(random);
  return logits;
}

class MaskLogitsOf : public ::testing::TestWithParam<std::size_t> {};

TEST_P(MaskLogitsOf, EqualDefinitionPixelByPixel) {
  const std::vector<float> logits = random_logits(GetParam(), 1);
  const BitMask mask = bit_mask(logits, 0.0F);
  const std::vector<float> soft = probabilities(logits);
  int area = 0;
  double sum = 0.0;
  for (std::size_t i = 0; i < logits.size(); ++i) {
    const double expected = 1.0 / (1.0 + std::exp(-static_cast<double>(logits[i])));
    EXPECT_NEAR(soft[i], expected, 1e-6);
    const bool inside = logits[i] > 0.0F;
    EXPECT_EQ(mask.words[i / 64] >> (i % 64) & 1, inside ? 1U : 0U) << i;
    if (!inside) continue;
    ++area;
    sum += expected;
  }
  EXPECT_EQ(mask.area, area);
  EXPECT_NEAR(probability_sum(logits, mask), sum, 1e-5 * (1.0 + sum));
}

INSTANTIATE_TEST_SUITE_P(NumbersOfPixels, MaskLogitsOf,
                         ::testing::Values(1U, 63U, 64U, 65U, 640U, 1001U));

TEST(MaskLogits, AreEmptyWithoutPixels) {
  const BitMask mask = bit_mask(std::vector<float>(), 0.0F);
  EXPECT_EQ(mask.area, 0);
  EXPECT_EQ(probability_sum({}, mask), 0.0F);
  EXPECT_TRUE(probabilities({}).empty());
}

}  // namespace
}  // namespace mms
