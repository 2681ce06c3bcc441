#include "mms/simulation/sensors/depth_sensor.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mms/simulation/sensors/sensor_preset.hpp"

namespace mms {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// A bright wall in frontal view.
ExactView wall(float z, int width = 320, int height = 240) {
  return {.depth = {width, height, z},
          .cosine = {width, height, 1.0F},
          .reflectance = {width, height, 0.95F},
          .gloss = {width, height, 0.0F},
          .object = {width, height, 0}};
}

/// The right half of the view at another depth.
ExactView step_at(int column, float left, float right) {
  ExactView view = wall(left);
  for (int y = 0; y < view.depth.height(); ++y) {
    for (int x = column; x < view.depth.width(); ++x) view.depth(x, y) = right;
  }
  return view;
}

DepthSensor ideal() {
  DepthSensor sensor;
  sensor.noise = {.base = 0.0, .quadratic = 0.0};
  sensor.step = 0.0;
  return sensor;
}

struct Statistics {
  double share = 0.0;  ///< of pixels with a depth
  double mean = 0.0;
  double deviation = 0.0;
};

Statistics of(const Image<float>& depth) {
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const float z : depth.pixels()) {
    if (z == 0.0F) continue;
    const double offset = static_cast<double>(z) - 1.0;
    count += 1.0;
    sum += offset;
    squares += offset * offset;
  }
  const double mean = sum / count;
  return {count / static_cast<double>(depth.size()), 1.0 + mean,
          std::sqrt(squares / count - mean * mean)};
}

class DepthPreset : public testing::TestWithParam<const char*> {};

TEST_P(DepthPreset, DeviatesByNoiseCurve) {
  const DepthSensor sensor = *sensor_preset(GetParam()).depth;
  for (const double z : {0.5, 0.83, 1.0, 1.7, 2.5, 4.0, 5.5, 7.0}) {
    const Statistics measured = of(measured_depth(wall(static_cast<float>(z)), sensor, 7));
    const bool by_disparity = sensor.quantisation == DepthQuantisation::kDisparity;
    const double step = by_disparity ? sensor.step * z * z : sensor.step;
    const double sigma = sensor.noise.sigma(z);
    const double expected = std::sqrt(sigma * sigma + step * step / 12.0);
    EXPECT_NEAR(measured.deviation, expected, 0.1 * expected) << z;
    EXPECT_NEAR(measured.mean, z, 0.1 * expected) << z;
    EXPECT_GT(measured.share, 0.99) << z;
  }
}

TEST_P(DepthPreset, NoDepthOutsideRange) {
  const DepthSensor sensor = *sensor_preset(GetParam()).depth;
  for (const double z : {0.0, 0.9, 0.99, 1.0, 1.01, 1.1}) {
    for (const double limit : {sensor.min_range, sensor.max_range}) {
      const ExactView view = wall(static_cast<float>(z * limit), 64, 48);
      const Image<float> measured = measured_depth(view, sensor, 7);
      for (const float depth : measured.pixels()) {
        if (depth == 0.0F) continue;
        EXPECT_GE(depth, static_cast<float>(sensor.min_range));
        EXPECT_LE(depth, static_cast<float>(sensor.max_range));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, DepthPreset, testing::Values("l515", "d435", "kinect"));

TEST(DepthSensor, IgnoresInvalidDepths) {
  for (const float z : {kInfinite, -kInfinite, std::numeric_limits<float>::quiet_NaN(), -1.0F}) {
    ExactView view = wall(2.0F, 64, 48);
    view.depth(30, 20) = z;
    const Image<float> depth = measured_depth(view, ideal(), 7);
    EXPECT_EQ(depth(30, 20), 0.0F);
    for (const float value : depth.pixels()) EXPECT_TRUE(value == 0.0F || value == 2.0F) << value;
  }
  ExactView view = wall(2.0F, 8, 6);
  for (Image<float>* image : {&view.cosine, &view.reflectance, &view.gloss}) {
    (*image)(3, 3) = std::numeric_limits<float>::quiet_NaN();
    const float z = measured_depth(view, DepthSensor{}, 7)(3, 3);
    EXPECT_TRUE(std::isfinite(z));
  }
  EXPECT_TRUE(measured_depth(ExactView{}, DepthSensor{}, 7).empty());
}

TEST(DepthSensor, QuantizesDepthOrDisparity) {
  DepthSensor sensor = ideal();
  sensor.step = 0.1;
  EXPECT_NEAR(measured_depth(wall(2.04F, 4, 4), sensor, 1)(1, 1), 2.0, 1e-6);
  EXPECT_NEAR(measured_depth(wall(2.06F, 4, 4), sensor, 1)(1, 1), 2.1, 1e-6);
  sensor.quantisation = DepthQuantisation::kDisparity;
  EXPECT_NEAR(measured_depth(wall(2.4F, 4, 4), sensor, 1)(1, 1), 1.0 / 0.4, 1e-5);
}

TEST(DepthSensor, NoiseGrowsWithIncidence) {
  DepthSensor sensor;
  sensor.noise = {.base = 0.01, .quadratic = 0.0};
  sensor.lost_cosine = 0.0;
  ExactView view = wall(2.0F);
  for (const auto& [cosine, growth] : {std::pair{0.5F, 1.5}, std::pair{0.05F, 4.0}}) {
    view.cosine = {320, 240, cosine};
    EXPECT_NEAR(of(measured_depth(view, sensor, 7)).deviation, 0.01 * growth, 0.0005 * growth);
  }
}

TEST(DepthSensor, LosesGrazingDarkAndGlossySurfaces) {
  const auto share = [](float z, float cosine, float reflectance, float gloss) {
    ExactView view = wall(z);
    view.cosine = {320, 240, cosine};
    view.reflectance = {320, 240, reflectance};
    view.gloss = {320, 240, gloss};
    DepthSensor sensor = ideal();
    sensor.lost_darkness = 0.1;
    const Image<float> depth = measured_depth(view, sensor, 7);
    return 1.0 -
           static_cast<double>(std::count(depth.pixels().begin(), depth.pixels().end(), 0.0F)) /
               static_cast<double>(depth.size());
  };
  EXPECT_EQ(share(2.0F, 0.12F, 0.9F, 0.0F), 0.0);
  EXPECT_NEAR(share(2.0F, 0.24F, 0.9F, 0.0F), 0.5, 0.02);
  EXPECT_EQ(share(2.0F, 0.37F, 0.9F, 0.0F), 1.0);
  EXPECT_EQ(share(8.9F, 1.0F, 0.08F, 0.0F), 0.0);
  EXPECT_NEAR(share(9.0F, 1.0F, 0.15F, 0.0F), 0.5, 0.02);
  EXPECT_EQ(share(2.0F, 1.0F, 0.08F, 0.0F), 1.0);
  EXPECT_EQ(share(2.0F, 1.0F, 0.9F, 1.0F), 1.0);
  EXPECT_EQ(share(2.0F, 0.6F, 0.9F, 1.0F), 0.0);
  EXPECT_NEAR(share(2.0F, 0.6F, 0.9F, 0.5F), 0.75, 0.02);
}

TEST(DepthSensor, LosesAndMixesPixelsOnlyAtBoundaries) {
  const Image<float> depth = measured_depth(step_at(150, 2.0F, 5.0F), ideal(), 7);
  double lost = 0.0;
  double mixed = 0.0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const float z = depth(x, y);
      const bool boundary = x >= 148 && x < 152;
      if (!boundary) {
        EXPECT_EQ(z, x < 150 ? 2.0F : 5.0F) << x;
      }
      if (z == 0.0F) lost += 1.0;
      if (z > 2.0F && z < 5.0F) mixed += 1.0;
    }
  }
  EXPECT_NEAR(lost / (4.0 * 240.0), 0.4, 0.05);
  EXPECT_NEAR(mixed / (4.0 * 240.0), 0.2, 0.05);
}

TEST(DepthSensor, DoesNotMixWithSky) {
  const Image<float> depth = measured_depth(step_at(150, 2.0F, kInfinite), ideal(), 7);
  for (const float z : depth.pixels()) EXPECT_TRUE(z == 0.0F || z == 2.0F) << z;
}

TEST(DepthSensor, DoesNotTakeSlopeForBoundary) {
  ExactView view = wall(2.0F);
  for (int y = 0; y < 240; ++y) {  // a floor 0.5 m below a camera of f = 300 px
    for (int x = 0; x < 320; ++x) view.depth(x, y) = 0.5F * 300.0F / static_cast<float>(y + 15);
  }
  DepthSensor sensor = ideal();
  sensor.max_range = 100.0;
  EXPECT_EQ(measured_depth(view, sensor, 7).pixels(), view.depth.pixels());
}

TEST(DepthSensor, DependsOnFrameNotOnThreads) {
  const ExactView view = step_at(100, 2.0F, 4.0F);
  Image<float> one;
  Image<float> two;
  tbb::task_arena(1).execute([&] { one = measured_depth(view, DepthSensor{}, 3); });
  tbb::task_arena(2).execute([&] { two = measured_depth(view, DepthSensor{}, 3); });
  EXPECT_EQ(one.pixels(), two.pixels());
  EXPECT_NE(one.pixels(), measured_depth(view, DepthSensor{}, 4).pixels());
}

}  // namespace
}  // namespace mms
