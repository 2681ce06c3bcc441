#include "mms/simulation/sensors/color_sensor.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <limits>

namespace mms {
namespace {

ColorSensor ideal() {
  ColorSensor sensor;
  sensor.read_noise = 0.0;
  sensor.shot_noise = 0.0;
  sensor.vignetting = 0.0;
  sensor.softness = 0.0;
  return sensor;
}

Image<Eigen::Vector3f> plain(float light, int width = 160, int height = 120) {
  return {width, height, Eigen::Vector3f::Constant(light)};
}

double srgb(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

struct Statistics {
  double mean = 0.0;
  double deviation = 0.0;
};

Statistics of_green(const Image<Rgb>& picture) {
  double sum = 0.0;
  double squares = 0.0;
  for (const Rgb& pixel : picture.pixels()) {
    sum += pixel.g;
    squares += static_cast<double>(pixel.g) * pixel.g;
  }
  const auto count = static_cast<double>(picture.size());
  return {sum / count, std::sqrt(squares / count - sum / count * sum / count)};
}

TEST(ColorSensor, FollowsSrgbCurve) {
  for (int i = 0; i <= 200; ++i) {
    const double light = i / 200.0 * i / 200.0;
    const Rgb pixel = develop(plain(static_cast<float>(light), 1, 1), ideal(), 1)(0, 0);
    EXPECT_NEAR(pixel.r, 255.0 * srgb(light), 0.55) << light;
    EXPECT_EQ(pixel.r, pixel.g);
    EXPECT_EQ(pixel.r, pixel.b);
  }
}

TEST(ColorSensor, KeepsChannelsApart) {
  Image<Eigen::Vector3f> radiance(5, 4, {1.0F, 0.0F, 0.2140411F});
  EXPECT_EQ(develop(radiance, ideal(), 1)(2, 1), (Rgb{255, 0, 128}));
}

TEST(ColorSensor, ClampsInvalidAndExtremeValues) {
  Image<Eigen::Vector3f> radiance = plain(0.2F, 9, 1);
  radiance(0, 0).setConstant(std::numeric_limits<float>::infinity());
  radiance(4, 0).setConstant(-3.0F);
  radiance(8, 0).setConstant(std::numeric_limits<float>::quiet_NaN());
  const Image<Rgb> picture = develop(radiance, ideal(), 1);
  EXPECT_EQ(picture(0, 0).r, 255);
  EXPECT_EQ(picture(4, 0).r, 0);
  EXPECT_EQ(picture(8, 0).r, 0);
  ColorSensor soft = ideal();
  soft.softness = 0.5;
  EXPECT_EQ(develop(radiance, soft, 1)(2, 0), develop(plain(0.2F, 1, 1), ideal(), 1)(0, 0));
}

TEST(ColorSensor, NoiseHasConfiguredDeviation) {
  ColorSensor sensor = ideal();
  sensor.read_noise = 1.5;
  sensor.shot_noise = 3.0;
  for (const double light : {0.1, 0.3, 0.6}) {
    const Statistics measured = of_green(develop(plain(static_cast<float>(light)), sensor, 5));
    const double rounding = 1.0 / 12.0;
    EXPECT_NEAR(measured.mean, 255.0 * srgb(light), 0.1);
    EXPECT_NEAR(measured.deviation, std::sqrt(2.25 + 9.0 * light + rounding), 0.06);
  }
}

TEST(ColorSensor, NoiseDiffersBetweenFramesPixelsAndChannels) {
  ColorSensor sensor = ideal();
  sensor.read_noise = 2.0;
  const Image<Rgb> one = develop(plain(0.3F), sensor, 1);
  EXPECT_NE(one.pixels(), develop(plain(0.3F), sensor, 2).pixels());
  double product = 0.0;
  double square = 0.0;
  const double mean = of_green(one).mean;
  for (std::size_t i = 1; i < one.size(); ++i) {
    product += (one[i].g - mean) * (one[i - 1].g - mean) + (one[i].g - mean) * (one[i].r - mean);
    square += (one[i].g - mean) * (one[i].g - mean);
  }
  EXPECT_LT(std::abs(product / square), 0.04);
}

TEST(ColorSensor, VignettingDarkensCornersByShare) {
  ColorSensor sensor = ideal();
  sensor.vignetting = 0.25;
  const Image<Rgb> picture = develop(plain(0.5F, 161, 121), sensor, 1);
  EXPECT_NEAR(picture(80, 60).g, 255.0 * srgb(0.5), 0.6);
  for (const int x : {0, 160}) {
    for (const int y : {0, 120}) EXPECT_NEAR(picture(x, y).g, 255.0 * srgb(0.375), 0.6);
  }
}

TEST(ColorSensor, SoftnessBlursPointAsGaussian) {
  ColorSensor sensor = ideal();
  sensor.softness = 0.8;
  Image<Eigen::Vector3f> radiance = plain(0.0F, 21, 21);
  radiance(10, 10).setConstant(1.0F);
  const Image<Rgb> picture = develop(radiance, sensor, 1);
  double norm = 0.0;
  for (int d = -4; d <= 4; ++d) norm += std::exp(-0.5 * d * d / 0.64);
  for (int d = 0; d <= 2; ++d) {
    const double light = std::exp(-0.5 * 2.0 * d * d / 0.64) / (norm * norm);
    EXPECT_NEAR(picture(10 + d, 10 - d).g, 255.0 * srgb(light), 1.0);
  }
  EXPECT_EQ(develop(plain(0.4F, 21, 21), sensor, 1).pixels(),
            develop(plain(0.4F, 21, 21), ideal(), 1).pixels());
}

TEST(ColorSensor, SameImageForAnyThreadCount) {
  Image<Eigen::Vector3f> radiance = plain(0.0F, 150, 101);
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    radiance[i].setConstant(static_cast<float>(i % 97) / 90.0F);
  }
  Image<Rgb> one;
  Image<Rgb> two;
  tbb::task_arena(1).execute([&] { one = develop(radiance, ColorSensor{}, 3); });
  tbb::task_arena(2).execute([&] { two = develop(radiance, ColorSensor{}, 3); });
  EXPECT_EQ(one.pixels(), two.pixels());
}

TEST(ColorSensor, AcceptsEmptyImage) {
  EXPECT_TRUE(develop(Image<Eigen::Vector3f>(), ColorSensor{}, 3).empty());
}

}  // namespace
}  // namespace mms
