#include "mms/evaluation/segmentation/mask_iou.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/evaluation/coco_cases.hpp"

namespace mms {
namespace {

Image<std::uint8_t> random_mask(std::mt19937& random, double share) {
  std::bernoulli_distribution on(share);
  Image<std::uint8_t> mask(13, 7);
  for (std::uint8_t& pixel : mask.pixels()) pixel = on(random) ? 1 : 0;
  return mask;
}

TEST(MaskIou, EqualsPixelCountOfRandomMasks) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const auto a = random_mask(random, 0.1 * (i % 11));
    const auto b = random_mask(random, 0.1 * (i % 7));
    std::uint64_t common = 0;
    std::uint64_t any = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      common += a[k] & b[k];
      any += a[k] | b[k];
    }
    const Rle runs_a = encode_rle(a);
    const Rle runs_b = encode_rle(b);
    EXPECT_EQ(mask_intersection(runs_a, runs_b), common);
    const double iou = any == 0 ? 0.0 : static_cast<double>(common) / static_cast<double>(any);
    EXPECT_EQ(mask_iou(MeasuredMask(runs_a), MeasuredMask(runs_b), false), iou);
  }
}

TEST(MaskIou, CrowdIouIsShareOfDetection) {
  const Rle detection = test::box(0, 0, 10, 10);
  const Rle crowd = test::box(0, 5, 100, 50);
  const MeasuredMask a(detection);
  const MeasuredMask b(crowd);
  EXPECT_EQ(mask_iou(a, b, true), 0.5);
  EXPECT_EQ(mask_iou(a, b, false), 50.0 / 5050.0);
}

TEST(MaskIou, IsZeroForAdjacentMasks) {
  const Rle a = test::box(0, 0, 10, 10);
  const Rle right = test::box(10, 0, 10, 10);
  const Rle below = test::box(0, 10, 10, 10);
  EXPECT_EQ(mask_iou(MeasuredMask(a), MeasuredMask(right), false), 0.0);
  EXPECT_EQ(mask_iou(MeasuredMask(a), MeasuredMask(below), true), 0.0);
}

TEST(MaskIou, IgnoresRunsOfLengthZero) {
  const Rle plain{2, 4, {1, 5, 2}};
  const Rle with_empty_runs{2, 4, {0, 0, 1, 3, 0, 2, 0, 0, 2}};
  EXPECT_EQ(mask_intersection(with_empty_runs, with_empty_runs), 5U);
  EXPECT_EQ(mask_intersection(plain, with_empty_runs), 5U);
  EXPECT_EQ(mask_iou(MeasuredMask(plain), MeasuredMask(with_empty_runs), false), 1.0);
}

TEST(MaskIou, IsZeroForEmptyMasks) {
  const Rle empty = test::box(0, 0, 0, 0);
  const Rle all = test::box(0, 0, 100, 100);
  const Rle no_runs;
  EXPECT_EQ(mask_iou(MeasuredMask(empty), MeasuredMask(empty), false), 0.0);
  EXPECT_EQ(mask_iou(MeasuredMask(empty), MeasuredMask(all), true), 0.0);
  EXPECT_EQ(mask_intersection(no_runs, no_runs), 0U);
}

}  // namespace
}  // namespace mms
