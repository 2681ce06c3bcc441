#include "mms/segmentation/solo/matrix_nms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mms {
namespace {

/// Scores as defined in SOLOv2's paper, with a loop for every sum.
std::vector<double> naive_scores(const std::vector<std::vector<float>>& masks,
                                 const std::vector<NmsCandidate>& candidates) {
  const std::size_t n = masks.size();
  std::vector<std::vector<double>> iou(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (candidates[i].category != candidates[j].category) continue;
      double both = 0.0;
      double any = 0.0;
      for (std::size_t k = 0; k < masks[i].size(); ++k) {
        const bool a = masks[i][k] > 0.5F;
        const bool b = masks[j][k] > 0.5F;
        both += a && b ? 1.0 : 0.0;
        any += a || b ? 1.0 : 0.0;
      }
      iou[i][j] = any > 0.0 ? both / any : 0.0;
    }
  }
  std::vector<double> scores;
  for (std::size_t j = 0; j < n; ++j) {
    double decay = 1.0;
    for (std::size_t i = 0; i < n; ++i) {
      double compensation = 0.0;
      for (std::size_t k = 0; k < i; ++k) compensation = std::max(compensation, iou[k][i]);
      decay = std::min(decay, std::exp(-2.0 * iou[i][j] * iou[i][j]) /
                                  std::exp(-2.0 * compensation * compensation));
    }
    scores.push_back(candidates[j].score * decay);
  }
  return scores;
}

TEST(MatrixNms, EqualsDoubleLoopOnRandomMasks) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::vector<float>> masks;
    std::vector<NmsCandidate> candidates;
    float score = 1.0F;
    for (int i = 0; i < 20; ++i) {
      std::vector<float> mask(150);  // not a multiple of a word's 64 bits
      const float share = uniform(random);
      for (float& value : mask) value = uniform(random) < share ? 0.9F : 0.1F;
      score *= 0.7F + 0.3F * uniform(random);
      candidates.push_back({static_cast<int>(random() % 2), score, bit_mask(mask, 0.5F)});
      masks.push_back(std::move(mask));
    }
    const std::vector<float> scores = matrix_nms(candidates);
    const std::vector<double> expected = naive_scores(masks, candidates);
    for (std::size_t i = 0; i < scores.size(); ++i) EXPECT_NEAR(scores[i], expected[i], 1e-5);
  }
}

TEST(MatrixNms, SecondOfEqualMasksDecaysByExpMinusTwo) {
  const BitMask mask = bit_mask({1.0F, 1.0F, 0.0F}, 0.5F);
  const std::vector<float> scores = matrix_nms({{0, 0.9F, mask}, {0, 0.8F, mask}});
  EXPECT_FLOAT_EQ(scores[0], 0.9F);
  EXPECT_NEAR(scores[1], 0.8 * std::exp(-2.0), 1e-6);
}

TEST(MatrixNms, KeepsOtherCategoriesAndDisjointMasks) {
  const BitMask left = bit_mask({1.0F, 1.0F, 0.0F, 0.0F}, 0.5F);
  const BitMask right = bit_mask({0.0F, 0.0F, 1.0F, 1.0F}, 0.5F);
  EXPECT_EQ(matrix_nms({{0, 0.9F, left}, {1, 0.8F, left}, {0, 0.7F, right}}),
            (std::vector<float>{0.9F, 0.8F, 0.7F}));
  EXPECT_TRUE(matrix_nms({}).empty());
}

}  // namespace
}  // namespace mms
