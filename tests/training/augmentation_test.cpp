#include "mms/training/data/augmentation.hpp"

#include <gtest/gtest.h>

#include <set>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "tests/training/samples.hpp"

namespace mms {
namespace {

using testing::box_object;
using testing::sample_of;

constexpr AugmentationConfig kUnchanged = {.scale_min = 1.0, .scale_max = 1.0, .flip = 0.0};

TEST(Jitter, ScaleOneChangesNothing) {
  RandomStream random(1);
  const Sample sample = sample_of(64, 48, {box_object(1, 10, 12, 20, 16)});
  const Sample same = jittered(sample, 64, 48, kUnchanged, random);
  EXPECT_EQ(same.image.pixels(), sample.image.pixels());
  ASSERT_EQ(same.objects.size(), 1U);
  EXPECT_EQ(same.objects[0].category, 1);
  EXPECT_EQ(same.objects[0].x, 10);
  EXPECT_EQ(same.objects[0].y, 12);
  EXPECT_EQ(same.objects[0].mask.pixels(), sample.objects[0].mask.pixels());
}

TEST(Jitter, MasksFollowRotatedImage) {
  RandomStream random(3);
  AugmentationConfig config = kUnchanged;
  config.roll = 1.0;
  Sample sample = sample_of(64, 48, {box_object(0, 20, 14, 20, 16)});
  sample.partial = {1};
  const Sample rotated = jittered(sample, 64, 48, config, random);
  EXPECT_EQ(rotated.partial, sample.partial);
  ASSERT_EQ(rotated.objects.size(), 1U);
  const ObjectMask& object = rotated.objects[0];
  EXPECT_NEAR(mask_area(object.mask), 20 * 16, 20);
  int moved = 0;
  for (int y = 0; y < object.mask.height(); ++y) {
    for (int x = 0; x < object.mask.width(); ++x) {
      // The color of each pixel is its place in the upright image.
      const Rgb from = rotated.image(object.x + x, object.y + y);
      const bool inside = from.r >= 20 && from.r < 40 && from.g >= 14 && from.g < 30;
      EXPECT_EQ(object.mask(x, y) != 0, inside && from.b == 77);
      moved += from.r != object.x + x;
    }
  }
  EXPECT_GT(moved, 0);
}

TEST(Jitter, DoesNotRotateBoxesWithoutMasks) {
  RandomStream random(3);
  AugmentationConfig config = kUnchanged;
  config.roll = 1.0;
  Sample sample = sample_of(64, 48, {box_object(0, 20, 14, 20, 16)});
  sample.objects[0].box_only = true;
  const Sample same = jittered(sample, 64, 48, config, random);
  EXPECT_EQ(same.image.pixels(), sample.image.pixels());
  EXPECT_TRUE(same.objects.at(0).box_only);
}

TEST(Jitter, MasksFollowMirroredImage) {
  RandomStream random(1);
  AugmentationConfig config = kUnchanged;
  config.flip = 1.0;
  const Sample sample = sample_of(64, 48, {box_object(0, 10, 12, 20, 16)});
  const Sample mirrored = jittered(sample, 64, 48, config, random);
  EXPECT_EQ(mirrored.image(0, 5), sample.image(63, 5));
  ASSERT_EQ(mirrored.objects.size(), 1U);
  EXPECT_EQ(mirrored.objects[0].x, 64 - 10 - 20);
  EXPECT_EQ(mirrored.objects[0].y, 12);
}

TEST(Jitter, PadsSmallerImages) {
  RandomStream random(1);
  AugmentationConfig config = kUnchanged;
  config.scale_min = config.scale_max = 0.5;
  const Sample small =
      jittered(sample_of(64, 48, {box_object(0, 10, 12, 20, 16)}), 64, 48, config, random);
  EXPECT_EQ(small.width, 32);
  EXPECT_EQ(small.height, 24);
  EXPECT_EQ(small.image(40, 30), (Rgb{124, 116, 104}));  // zero for the network
  ASSERT_EQ(small.objects.size(), 1U);
  EXPECT_EQ(small.objects[0].x, 5);
  EXPECT_EQ(small.objects[0].mask.width(), 10);
  EXPECT_EQ(small.objects[0].mask.height(), 8);
}

/// The mask stays on its pixels after cropping; red and green encode the original position.
TEST(Jitter, CroppingKeepsMasksOnTheirPixels) {
  AugmentationConfig config = kUnchanged;
  config.scale_min = config.scale_max = 2.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random(seed);
    const Sample large =
        jittered(sample_of(64, 48, {box_object(0, 20, 14, 24, 20)}), 64, 48, config, random);
    for (const ObjectMask& object : large.objects) {
      const Rgb corner = large.image(object.x + 1, object.y + 1);
      const Rgb last =
          large.image(object.x + object.mask.width() - 2, object.y + object.mask.height() - 2);
      EXPECT_GE(corner.r, 19);
      EXPECT_GE(corner.g, 13);
      EXPECT_LE(last.r, 44);
      EXPECT_LE(last.g, 34);
    }
  }
}

/// Less than half of a box may show something else.
TEST(Jitter, IgnoresTheRestOfABoxWithoutMask) {
  AugmentationConfig config = kUnchanged;
  config.scale_min = config.scale_max = 2.0;
  ObjectMask box = box_object(0, 24, 8, 16, 32);
  box.box_only = true;
  std::set<bool> ignored;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    RandomStream random(seed);
    for (const ObjectMask& object :
         jittered(sample_of(64, 48, {box}), 64, 48, config, random).objects) {
      EXPECT_EQ(object.crowd, mask_area(object.mask) < 0.5 * 32 * 64);
      ignored.insert(object.crowd);
    }
  }
  EXPECT_EQ(ignored.size(), 2U);
}

TEST(Jitter, DropsObjectsOutsideCrop) {
  AugmentationConfig config = kUnchanged;
  config.scale_min = config.scale_max = 4.0;
  int kept = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    RandomStream random(seed);
    kept += static_cast<int>(
        jittered(sample_of(64, 48, {box_object(0, 0, 0, 6, 6)}), 64, 48, config, random)
            .objects.size());
  }
  EXPECT_GT(kept, 0);
  EXPECT_LT(kept, 30);
}

/// Pastes with the first seed that pastes the object or not, as given; the number is random.
Sample pasted(std::vector<ObjectMask> below, const ObjectMask& above, bool is_pasted) {
  for (std::uint64_t seed = 0;; ++seed) {
    RandomStream random(seed);
    Sample target = sample_of(64, 48, below);
    Sample source = sample_of(64, 48, {above});
    for (Rgb& pixel : source.image.pixels()) pixel = {1, 2, 3};
    paste_objects(target, source, random);
    if ((target.image(above.x, above.y) == Rgb{1, 2, 3}) == is_pasted) return target;
  }
}

TEST(CopyPaste, CropsMasksBelow) {
  const Sample sample = pasted({box_object(0, 4, 4, 30, 30)}, box_object(1, 20, 10, 30, 10), true);
  ASSERT_EQ(sample.objects.size(), 2U);
  EXPECT_EQ(sample.objects[1].category, 1);
  EXPECT_EQ(mask_area(sample.objects[1].mask), 300);
  EXPECT_EQ(mask_area(sample.objects[0].mask), 900 - 14 * 10);
  EXPECT_EQ(sample.objects[0].mask(20, 10), 0);  // under it
  EXPECT_EQ(sample.image(20, 10), (Rgb{1, 2, 3}));
  EXPECT_EQ(sample.image(19, 10), (Rgb{19, 10, 77}));
}

TEST(CopyPaste, DropsHiddenObjects) {
  const Sample sample = pasted({box_object(0, 10, 10, 10, 10)}, box_object(1, 8, 8, 14, 14), true);
  ASSERT_EQ(sample.objects.size(), 1U);
  EXPECT_EQ(sample.objects[0].category, 1);
}

TEST(CopyPaste, DoesNotPasteBoxesWithoutMasks) {
  Sample source = sample_of(64, 48, {box_object(0, 20, 14, 20, 16)});
  source.objects[0].box_only = true;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    RandomStream random(seed);
    Sample target = sample_of(64, 48);
    paste_objects(target, source, random);
    EXPECT_TRUE(target.objects.empty());
  }
}

TEST(CopyPaste, MayPasteNothing) {
  const Sample sample = pasted({box_object(0, 10, 10, 10, 10)}, box_object(1, 8, 8, 14, 14), false);
  ASSERT_EQ(sample.objects.size(), 1U);
  EXPECT_EQ(sample.objects[0].category, 0);
}

TEST(ColorChanges, KeepObjectsAndCanBeDisabled) {
  RandomStream random(3);
  const Sample sample = sample_of(64, 48, {box_object(0, 10, 10, 10, 10)});
  Sample same = sample;
  change_colors(same, {.color = 0, .blur = 0, .noise = 0, .grey = 0}, random);
  EXPECT_EQ(same.image.pixels(), sample.image.pixels());
  Sample changed = sample;
  change_colors(changed, {.color = 1, .blur = 1, .noise = 1, .grey = 0}, random);
  EXPECT_NE(changed.image.pixels(), sample.image.pixels());
  EXPECT_EQ(changed.objects[0].mask.pixels(), sample.objects[0].mask.pixels());
}

TEST(ColorChanges, ExposureDarkensOrSaturates) {
  AugmentationConfig config = {.color = 0.0, .blur = 0.0, .noise = 0.0, .grey = 0.0};
  config.exposure = 1.0;
  bool darker = false;
  bool brighter = false;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random(seed);
    Sample sample = sample_of(64, 48);
    change_colors(sample, config, random);
    darker = darker || sample.image(40, 20).r < 25;
    brighter = brighter || sample.image(40, 20).r > 60;
  }
  EXPECT_TRUE(darker);
  EXPECT_TRUE(brighter);
}

TEST(ColorChanges, BlurSpreadsAPointAlongALineThroughIt) {
  constexpr int kLength = 11;
  RandomStream random(3);
  std::size_t longest = 0;
  for (int i = 0; i < 20; ++i) {
    Sample sample;
    sample.image = Image<Rgb>(41, 31);
    sample.image(20, 15) = {220, 220, 220};
    change_colors(sample, {.color = 0, .blur = 1, .blur_length = kLength, .noise = 0, .grey = 0},
                  random);
    int sum = 0;
    std::vector<Eigen::Vector2d> lit;
    for (int y = 0; y < 31; ++y) {
      for (int x = 0; x < 41; ++x) {
        if (sample.image(x, y).r == 0) continue;
        sum += sample.image(x, y).r;
        lit.emplace_back(x - 20, y - 15);
      }
    }
    EXPECT_NEAR(sum, 220, kLength) << "rounding aside";
    ASSERT_LE(lit.size(), std::size_t{kLength});
    longest = std::max(longest, lit.size());
    const Eigen::Vector2d end = lit.back();  // the lowest
    for (const Eigen::Vector2d& at : lit) {
      EXPECT_LE(at.norm(), 0.5 * kLength + 1);
      EXPECT_LE(std::abs(at.x() * end.y() - at.y() * end.x()), 1.5 * std::max(1.0, end.norm()));
    }
  }
  EXPECT_GT(longest, 8U);
}

TEST(ColorChanges, GreyHasNoColor) {
  RandomStream random(3);
  Sample sample = sample_of(64, 48);
  change_colors(sample, {.color = 0, .blur = 0, .noise = 0, .grey = 1}, random);
  for (const Rgb& pixel : sample.image.pixels()) {
    EXPECT_NEAR(pixel.r, pixel.g, 1);
    EXPECT_NEAR(pixel.b, pixel.g, 1);
  }
}

TEST(CopyPaste, IgnoresBoxesThatAreMostlyHidden) {
  ObjectMask box = box_object(0, 10, 8, 20, 24);
  box.box_only = true;
  EXPECT_TRUE(pasted({box}, box_object(1, 12, 10, 16, 20), true).objects.at(0).crowd);
  EXPECT_FALSE(pasted({box}, box_object(1, 12, 10, 6, 6), true).objects.at(0).crowd);
}

}  // namespace
}  // namespace mms
