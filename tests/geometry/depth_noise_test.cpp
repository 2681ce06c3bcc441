#include "mms/geometry/depth_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mms/geometry/noise_measurement.hpp"

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

/// A slanted floor and a wall with boxes before it, seen with `times` the default noise; the left
/// tenth has no return.
Image<float> noisy_image(double times) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const DepthNoise noise;
  Image<float> depth(320, 240);
  for (int y = 0; y < 240; ++y) {
    for (int x = 32; x < 320; ++x) {
      const bool is_box = y > 60 && y < 180 && x / 40 % 2 == 0;
      const double wall = 4.0 + 0.002 * x;
      const double z = is_box ? 2.5 : y < 120 ? wall : std::min(wall, 120.0 * 1.5 / (y - 118.0));
      depth(x, y) = static_cast<float>(z + times * noise.sigma(z) * normal(random));
    }
  }
  return depth;
}

TEST(NoiseMeasurement, MeasuresNoiseBesideEdgesAndSlants) {
  for (const double times : {0.5, 1.0, 2.0, 4.0}) {
    EXPECT_NEAR(noise_ratio(noisy_image(times), {}), times, 0.15 * times);
  }
}

TEST(NoiseMeasurement, RaisesTheNoiseOnly) {
  const DepthNoise assumed;
  EXPECT_EQ(measured_noise(assumed, noisy_image(0.3)).base, assumed.base);
  EXPECT_EQ(measured_noise(assumed, noisy_image(1.0)).quadratic, assumed.quadratic);
  const DepthNoise raised = measured_noise(assumed, noisy_image(3.0));
  EXPECT_NEAR(raised.quadratic / assumed.quadratic, 3.0, 0.45);
  EXPECT_NEAR(raised.base / assumed.base, 3.0, 0.45);
  const DepthNoise again = measured_noise(raised, noisy_image(3.0));
  EXPECT_EQ(again.base, raised.base);
}

TEST(NoiseMeasurement, NeedsDepth) {
  const DepthNoise assumed;
  for (const float nothing : {0.0F, INFINITY, std::nanf("")}) {
    EXPECT_EQ(noise_ratio(Image<float>(320, 240, nothing), assumed), 0.0);
  }
  EXPECT_EQ(noise_ratio({}, assumed), 0.0);
  EXPECT_EQ(noise_ratio(Image<float>(4, 4, 1.0F), assumed), 0.0);
}

}  // namespace
}  // namespace mms
