#include "mms/geometry/depth_noise.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

TEST(DepthNoise, EqualsNguyensModel) {
  const DepthNoise noise;
  EXPECT_DOUBLE_EQ(noise.sigma(0.4), 0.0012);
  EXPECT_DOUBLE_EQ(noise.sigma(2.4), 0.0012 + 0.0019 * 4.0);
  EXPECT_FLOAT_EQ(noise.sigma(2.4F), 0.0088F);
}

TEST(DepthNoise, IsConstantBelowMinimumRange) {
  const DepthNoise noise;
  EXPECT_DOUBLE_EQ(noise.sigma(0.1), noise.base);
  EXPECT_DOUBLE_EQ(noise.sigma(0.0), noise.base);
}

}  // namespace
}  // namespace mms
