#include "mms/evaluation/segmentation/mask_matching.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace mms {
namespace {

constexpr Verdict kHit = Verdict::kHit;
constexpr Verdict kFalseAlarm = Verdict::kFalseAlarm;
constexpr Verdict kIgnored = Verdict::kIgnored;
constexpr MatchObject kObject = {};
constexpr MatchObject kCrowd = {.crowd = true, .ignored = true};
constexpr MatchObject kOtherSize = {.crowd = false, .ignored = true};

/// The verdicts at the lowest threshold.
std::vector<Verdict> at_half(const Overlaps& overlaps, const std::vector<MatchObject>& objects) {
  std::vector<Verdict> verdicts;
  for (const Verdicts& all : match_masks(overlaps, objects)) verdicts.push_back(all[0]);
  return verdicts;
}

using List = std::vector<Verdict>;

TEST(MaskMatching, ThresholdsEqualNumpy) {
  EXPECT_EQ(kIouThresholds,
            (std::array{0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.8999999999999999, 0.95}));
}

TEST(MaskMatching, OverlapAtThresholdIsHit) {
  for (std::size_t i = 0; i < kIouThresholds.size(); ++i) {
    const auto verdicts = match_masks({{0.5 + 0.05 * static_cast<double>(i) + 1e-12}}, {kObject});
    const auto hits = std::count(verdicts[0].begin(), verdicts[0].end(), kHit);
    EXPECT_EQ(hits, static_cast<std::ptrdiff_t>(i) + 1);
  }
  EXPECT_EQ(at_half({{0.5}}, {kObject}), (List{kHit}));
  EXPECT_EQ(at_half({{0.4999999999}}, {kObject}), (List{kFalseAlarm}));
}

TEST(MaskMatching, MatchesHighestOverlapOnce) {
  EXPECT_EQ(at_half({{0.6, 0.9}, {0.0, 0.9}}, {kObject, kObject}), (List{kHit, kFalseAlarm}));
  EXPECT_EQ(at_half({{0.6, 0.9}, {0.7, 0.9}}, {kObject, kObject}), (List{kHit, kHit}));
}

TEST(MaskMatching, EqualOverlapsMatchLast) {
  EXPECT_EQ(at_half({{0.8, 0.8}, {0.8, 0.0}}, {kObject, kObject}), (List{kHit, kHit}));
  EXPECT_EQ(at_half({{0.8, 0.8}, {0.0, 0.8}}, {kObject, kObject}), (List{kHit, kFalseAlarm}));
}

TEST(MaskMatching, CrowdMatchesAnyNumberAfterObjects) {
  EXPECT_EQ(at_half({{1.0, 0.6}, {1.0, 0.6}, {0.9, 0.0}}, {kCrowd, kObject}),
            (List{kHit, kIgnored, kIgnored}));
}

TEST(MaskMatching, ObjectOfOtherSizeMatchesOnce) {
  EXPECT_EQ(at_half({{0.9}, {0.9}}, {kOtherSize}), (List{kIgnored, kFalseAlarm}));
}

TEST(MaskMatching, AllAreFalseAlarmsWithoutObjects) {
  EXPECT_EQ(at_half({{}, {}}, {}), (List{kFalseAlarm, kFalseAlarm}));
  EXPECT_TRUE(match_masks({}, {kObject}).empty());
}

}  // namespace
}  // namespace mms
