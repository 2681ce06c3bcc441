#include "mms/localization/features/intensity_pyramid.hpp"

#include <gtest/gtest.h>

#include "mms/geometry/camera.hpp"
#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

/// A wall at 2 m with that color of each pixel.
template <class ColorOf>
LabeledCloud wall(const ColorOf& color_of) {
  LabeledCloud cloud;
  cloud.camera = testing::box_camera();
  cloud.width = cloud.camera.width;
  cloud.height = cloud.camera.height;
  cloud.dynamic_pixels = Image<std::uint8_t>(cloud.width, cloud.height);
  const CameraModel camera(cloud.camera);
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      cloud.points.push_back((2.0 * camera.ray({x, y})).cast<float>());
      cloud.labels.push_back(PointLabel::kStatic);
      cloud.colors.push_back(color_of(x, y));
    }
  }
  return cloud;
}

Rgb ramp(int x, int y) {
  const auto grey = static_cast<std::uint8_t>(20 + x + y / 2);
  return {grey, grey, grey};
}

TEST(IntensityPyramid, LevelsHalveDownToMinimumSize) {
  const auto pyramid = build_intensity_pyramid(wall(ramp), 6);
  ASSERT_EQ(pyramid.size(), 3U);  // 160 x 120, 80 x 60, 40 x 30; 20 x 15 is too small
  for (std::size_t i = 0; i < pyramid.size(); ++i) {
    EXPECT_EQ(pyramid[i].camera.width, 160 >> i);
    EXPECT_EQ(pyramid[i].intensity.height(), 120 >> i);
    EXPECT_TRUE(pyramid[i].depth.same_size(pyramid[i].intensity));
    EXPECT_EQ(pyramid[i].camera, downscaled(testing::box_camera(), 1 << i));
  }
  EXPECT_EQ(build_intensity_pyramid(wall(ramp), 2).size(), 2U);
}

TEST(IntensityPyramid, LuminanceIsBt601) {
  const auto level = build_intensity_pyramid(wall([](int, int) { return Rgb{100, 50, 200}; }), 1);
  EXPECT_NEAR(level[0].intensity(5, 5).value, 0.299F * 100 + 0.587F * 50 + 0.114F * 200, 1e-3F);
}

TEST(IntensityPyramid, DerivativesAreCentralDifferences) {
  const auto pyramid = build_intensity_pyramid(wall(ramp), 2);
  const IntensitySample fine = pyramid[0].intensity(50, 41);
  EXPECT_NEAR(fine.dx, 1.0F, 1e-4F);
  EXPECT_NEAR(fine.dy, 0.5F, 1e-4F);
  const IntensitySample coarse = pyramid[1].intensity(30, 20);
  EXPECT_NEAR(coarse.dx, 2.0F, 1e-4F);
  EXPECT_NEAR(coarse.dy, 1.0F, 1e-4F);
  // Blocks are averaged: pixel (30, 20) is the mean of (60 ... 61, 40 ... 41).
  EXPECT_NEAR(coarse.value, 20.0F + 60.5F + 20.0F, 1e-4F);
}

TEST(IntensityPyramid, OnlyStaticPixelsHaveDepth) {
  LabeledCloud cloud = wall(ramp);
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(160 * y + x); };
  cloud.labels[at(10, 10)] = PointLabel::kDynamic;
  for (const auto& [x, y] : {std::pair{20, 20}, {21, 20}, {20, 21}, {21, 21}}) {
    cloud.labels[at(x, y)] = PointLabel::kInvalid;
    cloud.points[at(x, y)].setConstant(NAN);
  }
  const auto pyramid = build_intensity_pyramid(cloud, 2);
  EXPECT_EQ(pyramid[0].depth(10, 10), 0.0F);
  EXPECT_EQ(pyramid[0].depth(20, 20), 0.0F);
  EXPECT_NEAR(pyramid[0].depth(11, 10), 2.0F, 1e-6F);
  EXPECT_EQ(pyramid[1].depth(10, 10), 0.0F);
  EXPECT_NEAR(pyramid[1].depth(5, 5), 2.0F, 1e-6F);  // three static pixels remain
}

TEST(IntensityPyramid, PixelsNearDynamicColorsHaveNoDepth) {
  LabeledCloud cloud = wall(ramp);
  cloud.dynamic_pixels(40, 40) = 1;
  const auto pyramid = build_intensity_pyramid(cloud, 3);
  for (int level = 0; level < 3; ++level) {
    const Image<float>& depth = pyramid[static_cast<std::size_t>(level)].depth;
    const int x = 40 >> level;
    EXPECT_EQ(depth(x, x), 0.0F);
    EXPECT_EQ(depth(x + 1, x - 1), 0.0F);
    EXPECT_NEAR(depth(x + 2, x), 2.0F, 1e-6F);
  }
}

TEST(IntensityPyramid, BlockAtDepthEdgeTakesNearerSurface) {
  LabeledCloud cloud = wall(ramp);
  for (int y = 0; y < 120; ++y) {
    for (int x = 51; x < 160; ++x) cloud.points[static_cast<std::size_t>(160 * y + x)] *= 2.0F;
  }
  const auto pyramid = build_intensity_pyramid(cloud, 2);
  EXPECT_NEAR(pyramid[1].depth(24, 30), 2.0F, 1e-6F);
  EXPECT_NEAR(pyramid[1].depth(25, 30), 2.0F, 1e-6F);  // pixels 50 (2 m) and 51 (4 m)
  EXPECT_NEAR(pyramid[1].depth(26, 30), 4.0F, 1e-6F);
}

}  // namespace
}  // namespace mms
