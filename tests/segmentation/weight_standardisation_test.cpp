#include "mms/segmentation/weights/weight_standardisation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mms {
namespace {

Weights one_conv() {
  Weights weights;
  weights.tensors["c.weight"] = {{2, 3, 1, 1}, {1.0F, 2.0F, 6.0F, 0.1F, 0.1F, 0.4F}};
  weights.tensors["c.weight_gamma"] = {{2, 1, 1, 1}, {1.0F, 0.5F}};
  weights.tensors["c.weight_beta"] = {{2, 1, 1, 1}, {0.0F, 3.0F}};
  return weights;
}

std::vector<float> convolved_with(const Weights& weights) {
  std::vector<float> values = weights.tensors.at("c.weight").values;
  standardise(values, weights.tensors.at("c.weight_gamma").values,
              weights.tensors.at("c.weight_beta").values);
  return values;
}

TEST(WeightStandardisation, EqualsMmcv) {
  const std::vector<float> values = convolved_with(one_conv());
  const double first = std::sqrt(7.0 + 1e-5);    // unbiased variance of 1, 2, 6
  const double second = std::sqrt(0.03 + 1e-5);  // of 0.1, 0.1, 0.4
  const std::vector<double> expected = {-2.0 / first,
                                        -1.0 / first,
                                        3.0 / first,
                                        3.0 - 0.5 * 0.1 / second,
                                        3.0 - 0.5 * 0.1 / second,
                                        3.0 + 0.5 * 0.2 / second};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-6);
}

TEST(WeightStandardisation, KeepsWeight) {
  Weights weights = one_conv();
  keep_weight("c", weights);
  const std::vector<float> values = convolved_with(weights);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(values[i], one_conv().tensors.at("c.weight").values[i], 1e-6);
  }
}

TEST(WeightStandardisation, SettledWeightsAreStandardized) {
  Weights weights = one_conv();
  settle_standardisation(weights);
  EXPECT_EQ(weights.tensors.at("c.weight").values, convolved_with(one_conv()));
  const std::vector<float> values = convolved_with(weights);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(values[i], convolved_with(one_conv())[i], 1e-6);
  }
}

}  // namespace
}  // namespace mms
