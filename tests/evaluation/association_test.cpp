#include "mms/evaluation/trajectory/stamp_matching.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace mms {
namespace {

constexpr Duration kTolerance = std::chrono::milliseconds(20);

Trajectory at_milliseconds(const std::vector<int>& stamps) {
  Trajectory trajectory;
  for (const int stamp : stamps) trajectory.push_back({Timestamp(stamp * 1'000'000LL), {}});
  return trajectory;
}

void set_nan(StampedPose& pose) {
  Eigen::Isometry3d broken = Eigen::Isometry3d::Identity();
  broken.translation().y() = std::numeric_limits<double>::quiet_NaN();
  pose.T_world_sensor = Transform<World, Sensor>(broken);
}

using Matches = std::vector<PoseMatch>;

TEST(Association, MatchesNearestWithinTolerance) {
  const auto matches = match_by_stamp(at_milliseconds({0, 30, 60, 200}),
                                      at_milliseconds({14, 16, 61, 150, 220}), kTolerance);
  EXPECT_EQ(matches, (Matches{{0, 0}, {1, 1}, {2, 2}, {3, 4}}));
}

TEST(Association, ToleranceIsInclusive) {
  EXPECT_EQ(match_by_stamp(at_milliseconds({0}), at_milliseconds({20}), kTolerance).size(), 1U);
  EXPECT_TRUE(match_by_stamp(at_milliseconds({0}), at_milliseconds({21}), kTolerance).empty());
}

TEST(Association, MatchesReferencePoseOnceToNearest) {
  const auto matches =
      match_by_stamp(at_milliseconds({100}), at_milliseconds({95, 101, 108}), kTolerance);
  EXPECT_EQ(matches, (Matches{{0, 1}}));
}

TEST(Association, MatchesFirstOfDuplicatedStamps) {
  const auto matches =
      match_by_stamp(at_milliseconds({100, 100}), at_milliseconds({100, 100}), kTolerance);
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches.front(), (PoseMatch{0, 0}));
}

TEST(Association, NeedsNoOrder) {
  const auto matches =
      match_by_stamp(at_milliseconds({200, 0, 100}), at_milliseconds({101, 201, 1}), kTolerance);
  EXPECT_EQ(matches, (Matches{{1, 2}, {2, 0}, {0, 1}}));
}

TEST(Association, IgnoresNonFinitePoses) {
  Trajectory reference = at_milliseconds({0, 10});
  set_nan(reference[0]);
  EXPECT_EQ(match_by_stamp(reference, at_milliseconds({0}), kTolerance), (Matches{{1, 0}}));
  EXPECT_EQ(match_by_index(reference, reference), (Matches{{1, 1}}));
}

TEST(Association, EmptyTrajectoriesGiveNoMatches) {
  EXPECT_TRUE(match_by_stamp({}, at_milliseconds({0}), kTolerance).empty());
  EXPECT_TRUE(match_by_stamp(at_milliseconds({0}), {}, kTolerance).empty());
  EXPECT_TRUE(match_by_index({}, at_milliseconds({0})).empty());
}

TEST(Association, IndexMatchingStopsAtShorterTrajectory) {
  EXPECT_EQ(match_by_index(at_milliseconds({0, 1, 2}), at_milliseconds({7, 8})).size(), 2U);
}

}  // namespace
}  // namespace mms
