#include "mms/evaluation/segmentation/pixel_scores.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/evaluation/coco_cases.hpp"

namespace mms {
namespace {

using test::add_person;
using test::box;
using test::empty_truth;

constexpr std::size_t kTall = 0;
constexpr std::size_t kSmall = 2;

TEST(PixelScores, CountTheUnionOfMasks) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 10, 40));
  // Two masks that overlap cover rows 0 to 29, and 100 pixels beside the person.
  const PixelScores scores =
      pixel_scores(truth, {{1, 1, 0.9, box(0, 0, 10, 20)}, {1, 1, 0.4, box(0, 10, 15, 20)}});
  EXPECT_EQ(scores.all.objects, 1);
  EXPECT_DOUBLE_EQ(scores.all.recall(), 0.75);
  EXPECT_DOUBLE_EQ(scores.all.precision(), 300.0 / 400.0);
}

TEST(PixelScores, LeaveOutMasksOfLowScore) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 10, 40));
  const PixelScores scores = pixel_scores(truth, {{1, 1, 0.2, box(0, 0, 10, 40)}});
  EXPECT_EQ(scores.all.recall(), 0.0);
  EXPECT_TRUE(std::isnan(scores.all.precision()));
  PixelScoreOptions options;
  options.min_score = 0.2;
  EXPECT_EQ(pixel_scores(truth, {{1, 1, 0.2, box(0, 0, 10, 40)}}, options).all.recall(), 1.0);
}

TEST(PixelScores, DivideByHeight) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 10, 40));
  add_person(truth, 1, box(50, 0, 10, 10));
  const PixelScores scores =
      pixel_scores(truth, {{1, 1, 0.9, box(0, 0, 10, 40)}, {1, 1, 0.9, box(50, 50, 10, 10)}});
  EXPECT_EQ(scores.by_height[kTall].objects, 1);
  EXPECT_EQ(scores.by_height[kTall].recall(), 1.0);
  EXPECT_EQ(scores.by_height[kTall].precision(), 1.0);
  EXPECT_EQ(scores.by_height[kSmall].objects, 1);
  EXPECT_EQ(scores.by_height[kSmall].recall(), 0.0);
  EXPECT_EQ(scores.by_height[kSmall].precision(), 0.0);
}

TEST(PixelScores, IgnoreCrowds) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 10, 40));
  add_person(truth, 1, box(40, 0, 40, 40)).iscrowd = true;
  const PixelScores scores =
      pixel_scores(truth, {{1, 1, 0.9, box(0, 0, 10, 40)}, {1, 1, 0.9, box(45, 0, 10, 40)}});
  EXPECT_EQ(scores.all.objects, 1);
  EXPECT_EQ(scores.all.precision(), 1.0);
}

TEST(PixelScores, CountMasksInImagesWithoutObjects) {
  const PixelScores scores = pixel_scores(empty_truth(1), {{1, 1, 0.9, box(0, 0, 10, 40)}});
  EXPECT_EQ(scores.all.precision(), 0.0);
  EXPECT_TRUE(std::isnan(scores.all.recall()));
}

}  // namespace
}  // namespace mms
