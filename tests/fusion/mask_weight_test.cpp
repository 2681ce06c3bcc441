#include "mms/fusion/masks/mask_weight.hpp"

#include <gtest/gtest.h>

#include "mms/core/random_stream.hpp"
#include "mms/geometry/image_blur.hpp"

namespace mms {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;

/// Gray rectangles of random sizes, moved by `blur` pixels to the right while exposed.
std::vector<Rgb> rectangles(int blur) {
  RandomStream random(1);
  Image<float> sharp(kWidth, kHeight, 100.0F);
  for (int i = 0; i < 60; ++i) {
    const auto x = static_cast<int>(random.below(kWidth - 40));
    const auto y = static_cast<int>(random.below(kHeight - 40));
    const float gray = random.between(20.0F, 230.0F);
    for (int v = y; v < y + 40; ++v) {
      for (int u = x; u < x + 30; ++u) sharp(u, v) = gray;
    }
  }
  std::vector<Rgb> colors;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      float sum = 0.0F;
      for (int k = 0; k <= blur; ++k) sum += sharp(std::min(x + k, kWidth - 1), y);
      const auto gray = static_cast<std::uint8_t>(sum / static_cast<float>(blur + 1));
      colors.push_back({gray, gray, gray});
    }
  }
  return colors;
}

/// A cloud with one object that was followed for that long [s].
LabeledCloud cloud_with(double followed, int blur) {
  LabeledCloud cloud;
  cloud.width = kWidth;
  cloud.height = kHeight;
  cloud.colors = rectangles(blur);
  cloud.clusters.resize(1);
  cloud.clusters[0].instance = 0;
  cloud.clusters[0].followed = followed;
  return cloud;
}

float weight(LabeledCloud cloud, Plausibility judged = Plausibility::kPlausible) {
  weigh_masks({judged}, cloud);
  return cloud.clusters[0].weight;
}

TEST(ImageBlur, GrowsWithTheBlur) {
  double last = 0.0;
  for (const int blur : {0, 2, 4, 8, 16}) {
    const double measured = image_blur(rectangles(blur), kWidth, kHeight);
    EXPECT_GT(measured, last) << blur;
    EXPECT_LE(measured, 1.0);
    last = measured;
  }
}

TEST(ImageBlur, IsZeroForAnImageOfOneColor) {
  EXPECT_EQ(image_blur(std::vector<Rgb>(kWidth * kHeight, Rgb{9, 9, 9}), kWidth, kHeight), 0.0);
}

TEST(MaskWeight, FallsForNewMasksInBlurredImages) {
  EXPECT_EQ(weight(cloud_with(0.0, 0)), 1.0F);
  EXPECT_EQ(weight(cloud_with(0.0, 15)), 0.5F);
  EXPECT_EQ(weight(cloud_with(1.5, 15)), 1.0F);
}

TEST(MaskWeight, FallsForDoubtfulMasks) {
  EXPECT_EQ(weight(cloud_with(1.5, 0), Plausibility::kDoubtful), 0.5F);
  EXPECT_EQ(weight(cloud_with(0.0, 15), Plausibility::kDoubtful), 0.25F);
}

TEST(MaskWeight, FallsForNewMasksInFastTurns) {
  for (const double followed : {0.0, 1.5}) {
    LabeledCloud cloud = cloud_with(followed, 0);
    weigh_masks_in_turn(0.2, cloud);
    EXPECT_EQ(cloud.clusters[0].weight, 1.0F);
    weigh_masks_in_turn(1.0, cloud);
    EXPECT_EQ(cloud.clusters[0].weight, followed > 1.0 ? 1.0F : 0.5F);
  }
}

}  // namespace
}  // namespace mms
