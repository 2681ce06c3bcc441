#include "mms/training/data/target_assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/training/samples.hpp"

namespace mms {
namespace {

using testing::box_object;
using testing::sample_of;

/// Grids of 40, 36, 24, 16, 12; ranges up to 32, 16-64, 32-128, 64-256, 128 and more.
HeadConfig head() {
  HeadConfig config;
  config.grid_density = 1.0;
  config.object_scale = 32;
  return config;
}

std::set<int> levels_of(const ImageTargets& targets) {
  std::set<int> levels;
  for (const auto& pair : targets.pairs) levels.insert(pair.level);
  return levels;
}

std::set<int> cells_of(const ImageTargets& targets, int level) {
  std::set<int> cells;
  for (const auto& pair : targets.pairs) {
    if (pair.level == level) cells.insert(pair.cell);
  }
  return cells;
}

int count(const ImageTargets& targets, std::size_t level, int value) {
  const auto& all = targets.categories[level];
  return static_cast<int>(std::count(all.begin(), all.end(), value));
}

TEST(TargetAssignment, SizeSelectsLevels) {
  const auto levels = [](int side) {
    return levels_of(
        assign_targets(sample_of(320, 256, {box_object(0, 8, 8, side, side)}), head()));
  };
  EXPECT_EQ(levels(12), (std::set<int>{0}));
  EXPECT_EQ(levels(16), (std::set<int>{0, 1}));  // the ranges are closed
  EXPECT_EQ(levels(32), (std::set<int>{0, 1, 2}));
  EXPECT_EQ(levels(50), (std::set<int>{1, 2}));
  EXPECT_EQ(levels(100), (std::set<int>{2, 3}));
  EXPECT_EQ(levels(200), (std::set<int>{3, 4}));
}

/// A box of 100x100 px at (110, 78), center (159.5, 127.5); level 2 has 24 cells of 13.3 x 10.7 px.
/// A fifth of the box spans 149.5-169.5 and 117.5-137.5: columns 11-12, rows 11-12.
TEST(TargetAssignment, CenterOfBoxClaimsCells) {
  const ImageTargets targets =
      assign_targets(sample_of(320, 256, {box_object(1, 110, 78, 100, 100)}), head());
  EXPECT_EQ(cells_of(targets, 2),
            (std::set<int>{11 * 24 + 11, 11 * 24 + 12, 12 * 24 + 11, 12 * 24 + 12}));
  for (const int cell : cells_of(targets, 2)) {
    EXPECT_EQ(targets.categories[2][static_cast<std::size_t>(cell)], 1);
  }
  EXPECT_EQ(count(targets, 2, ImageTargets::kBackground), 24 * 24 - 4);
  EXPECT_EQ(count(targets, 0, ImageTargets::kBackground), 40 * 40);
}

TEST(TargetAssignment, ClaimsAtMostThreeByThreeCells) {
  const ImageTargets targets =
      assign_targets(sample_of(320, 256, {box_object(0, 2, 30, 316, 30)}), head());
  for (int level = 0; level < HeadConfig::kLevels; ++level) {
    EXPECT_LE(cells_of(targets, level).size(), 9U);
  }
  EXPECT_FALSE(cells_of(targets, 2).empty());
}

TEST(TargetAssignment, SmallerObjectHasACellAlone) {
  const ImageTargets targets = assign_targets(
      sample_of(320, 256, {box_object(1, 145, 113, 30, 30), box_object(0, 140, 108, 40, 40)}),
      head());
  EXPECT_EQ(targets.masks.size(), 2U);
  std::set<std::pair<int, int>> cells;
  for (const auto& pair : targets.pairs) {
    EXPECT_TRUE(cells.insert({pair.level, pair.cell}).second);
  }
  EXPECT_GT(count(targets, 1, 1), 0);  // the small one, although it is listed first
}

TEST(TargetAssignment, UsesCenterOfMass) {
  ObjectMask l_shape = box_object(0, 100, 100, 60, 60);
  for (int y = 0; y < 50; ++y) {
    for (int x = 10; x < 60; ++x) l_shape.mask(x, y) = 0;  // an L: mass low and to the left
  }
  const ImageTargets targets = assign_targets(sample_of(320, 256, {l_shape}), head());
  const int cell = *cells_of(targets, 1).begin();
  EXPECT_LT((cell % 36 + 0.5) * 320 / 36, 126.0);
  EXPECT_GT((cell / 36 + 0.5) * 256 / 36, 130.0);
}

TEST(TargetAssignment, MasksHaveQuarterSize) {
  const ImageTargets targets =
      assign_targets(sample_of(320, 256, {box_object(0, 40, 80, 21, 24)}), head());
  ASSERT_EQ(targets.masks.size(), 1U);
  const Image<std::uint8_t>& mask = targets.masks[0];
  EXPECT_EQ(mask.width(), 80);
  EXPECT_EQ(mask.height(), 64);
  EXPECT_EQ(mask_area(mask), 5 * 6);  // a sixth column with 1 of 4 pixels is not the object's
  EXPECT_EQ(mask(10, 20), 1);
  EXPECT_EQ(mask(9, 20), 0);
}

TEST(TargetAssignment, IgnoresCrowdsWithoutObject) {
  ObjectMask crowd = box_object(0, 0, 0, 160, 256);
  crowd.crowd = true;
  const ImageTargets targets =
      assign_targets(sample_of(320, 256, {crowd, box_object(0, 60, 100, 40, 40)}), head());
  EXPECT_EQ(targets.masks.size(), 1U);
  const int positive = static_cast<int>(cells_of(targets, 1).size());
  EXPECT_GT(positive, 0);
  EXPECT_EQ(count(targets, 1, ImageTargets::kIgnored), 36 * 18 - positive);
  EXPECT_EQ(count(targets, 1, ImageTargets::kBackground), 36 * 18);
}

}  // namespace
}  // namespace mms
