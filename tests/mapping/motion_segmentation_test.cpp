#include "mms/mapping/motion_segmentation/motion_segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/mapping/synthetic_cloud.hpp"

namespace mms {
namespace {

using test::organised_cloud;
using test::pose;

constexpr std::size_t kComponent = 40 * 60;  // pixels

Timestamp at(double seconds) {
  return Timestamp(static_cast<std::int64_t>(1e9 * seconds));
}

/// A wall at 3 m, with something 0.6 m wide at 2 m before it, `left` pixels from the left.
LabeledCloud wall_with_thing(double seconds, int left = -1000, float depth = 2.0F) {
  LabeledCloud cloud = organised_cloud([=](int x, int y, const Eigen::Vector3f&) {
    return x >= left && x < left + 40 && y >= 30 && y < 90 ? depth : 3.0F;
  });
  cloud.stamp = at(seconds);
  return cloud;
}

std::size_t dynamic_points(const LabeledCloud& cloud) {
  return static_cast<std::size_t>(
      std::count(cloud.labels.begin(), cloud.labels.end(), PointLabel::kDynamic));
}

const Transform<World, Sensor> kHere = pose({0, 0, 0});

MotionSegmentation after_a_view_of_the_wall(const MotionSegmentationConfig& config = {}) {
  MotionSegmentation movement(config, {});
  movement.remember(wall_with_thing(0.0), kHere);
  return movement;
}

TEST(MotionSegmentation, IsWhatStandsWhereSpaceWasFree) {
  LabeledCloud cloud = wall_with_thing(0.5, 60);
  const Image<std::uint8_t> moved = after_a_view_of_the_wall().relabel(cloud, kHere);
  EXPECT_EQ(dynamic_points(cloud), kComponent);
  ASSERT_FALSE(moved.empty());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_EQ(moved[i] != 0, cloud.labels[i] == PointLabel::kDynamic);
    EXPECT_EQ(cloud.dynamic_pixels[i], moved[i]);
    EXPECT_EQ(moved[i] != 0, cloud.points[i].z() == 2.0F);
  }
}

TEST(MotionSegmentation, IsAClusterOfUnknownClass) {
  LabeledCloud cloud = wall_with_thing(0.5, 60);
  after_a_view_of_the_wall().relabel(cloud, kHere);
  ASSERT_EQ(cloud.clusters.size(), 1U);
  const DynamicCluster& component = cloud.clusters[0];
  EXPECT_EQ(component.object_class, ObjectClass::kUnknown);
  EXPECT_EQ(component.score, 0.0F);
  EXPECT_EQ(component.instance, -1);
  EXPECT_EQ(component.points, static_cast<int>(kComponent));
  EXPECT_TRUE(component.centroid.isApprox(0.5F * (component.box_min + component.box_max), 1e-3F));
  EXPECT_NEAR(component.box_max.x() - component.box_min.x(), 39 * 2.0F / 130.0F, 1e-3F);
  EXPECT_EQ(component.box_min.z(), 2.0F);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    EXPECT_EQ(cloud.cluster[i] == 0, cloud.labels[i] == PointLabel::kDynamic);
  }
}

/// Makes the points of `wall_with_thing`'s component with y in [low, high) those of a person.
void name_rows(LabeledCloud& cloud, int low, int high) {
  cloud.clusters.emplace_back().points = 40 * (high - low);
  for (int y = low; y < high; ++y) {
    for (int x = 60; x < 100; ++x) {
      const auto i = static_cast<std::size_t>(160 * y + x);
      cloud.labels[i] = PointLabel::kDynamic;
      cloud.cluster[i] = 0;
    }
  }
}

TEST(MotionSegmentation, ThatAMaskLeftOutBelongsToTheObject) {
  LabeledCloud cloud = wall_with_thing(0.5, 60);
  name_rows(cloud, 30, 60);
  EXPECT_FALSE(after_a_view_of_the_wall().relabel(cloud, kHere).empty());
  ASSERT_EQ(cloud.clusters.size(), 1U);
  EXPECT_EQ(cloud.clusters[0].object_class, ObjectClass::kPerson);
  EXPECT_EQ(cloud.clusters[0].points, static_cast<int>(kComponent));
  EXPECT_EQ(std::count(cloud.cluster.begin(), cloud.cluster.end(), 0),
            static_cast<std::ptrdiff_t>(kComponent));
}

/// All of `wall_with_thing`'s component but the 4 pixels at its right, too few for a disc.
void name_all_but_a_strip(LabeledCloud& cloud) {
  name_rows(cloud, 30, 90);
  for (int y = 30; y < 90; ++y) {
    for (int x = 96; x < 100; ++x) {
      const auto i = static_cast<std::size_t>(160 * y + x);
      cloud.labels[i] = PointLabel::kStatic;
      cloud.cluster[i] = -1;
    }
  }
  cloud.clusters[0].points = 36 * 60;
}

TEST(MotionSegmentation, TooThinForADiscBelongsToTheObjectBeside) {
  LabeledCloud cloud = wall_with_thing(0.5, 60);
  name_all_but_a_strip(cloud);
  EXPECT_FALSE(after_a_view_of_the_wall().relabel(cloud, kHere).empty());
  EXPECT_EQ(dynamic_points(cloud), kComponent);
  ASSERT_EQ(cloud.clusters.size(), 1U);
  EXPECT_EQ(cloud.clusters[0].points, static_cast<int>(kComponent));
}

TEST(MotionSegmentation, AStripThatOnlyTheImageJoinsToAnObjectStays) {
  LabeledCloud cloud = wall_with_thing(0.5, 60);
  name_all_but_a_strip(cloud);
  for (int y = 30; y < 90; ++y) {
    for (int x = 96; x < 100; ++x) cloud.points[static_cast<std::size_t>(160 * y + x)] *= 0.8F;
  }
  after_a_view_of_the_wall().relabel(cloud, kHere);
  EXPECT_EQ(dynamic_points(cloud), std::size_t{36 * 60});
}

TEST(MotionSegmentation, BesideAnObjectInTheImageButNotInSpaceIsAnotherThing) {
  LabeledCloud cloud = wall_with_thing(0.5, 60);
  name_rows(cloud, 30, 60);
  for (int y = 60; y < 90; ++y) {
    for (int x = 60; x < 100; ++x) cloud.points[static_cast<std::size_t>(160 * y + x)] *= 0.8F;
  }
  EXPECT_FALSE(after_a_view_of_the_wall().relabel(cloud, kHere).empty());
  ASSERT_EQ(cloud.clusters.size(), 2U);
  EXPECT_EQ(cloud.clusters[1].object_class, ObjectClass::kUnknown);
}

TEST(MotionSegmentation, IsSeenByACameraThatMoves) {
  // Half a metre nearer to both.
  LabeledCloud cloud = organised_cloud([](int x, int y, const Eigen::Vector3f&) {
    return x >= 60 && x < 100 && y >= 30 && y < 90 ? 1.5F : 2.5F;
  });
  after_a_view_of_the_wall().relabel(cloud, pose({0, 0, 0.5}));
  EXPECT_EQ(dynamic_points(cloud), kComponent);
}

TEST(MotionSegmentation, IsNothingWithoutAViewOrWhenSwitchedOff) {
  LabeledCloud cloud = wall_with_thing(0.5, 60);
  EXPECT_TRUE(MotionSegmentation({}, {}).relabel(cloud, kHere).empty());
  EXPECT_TRUE(after_a_view_of_the_wall({.enabled = false}).relabel(cloud, kHere).empty());
  EXPECT_EQ(dynamic_points(cloud), 0U);
}

TEST(MotionSegmentation, IsNotWhatStoodThereOrWasHidden) {
  MotionSegmentation movement({}, {});
  movement.remember(wall_with_thing(0.0, 60), kHere);
  LabeledCloud standing = wall_with_thing(0.5, 60);
  EXPECT_TRUE(movement.relabel(standing, kHere).empty());
  LabeledCloud behind = wall_with_thing(0.5, 60, 2.5F);
  EXPECT_TRUE(movement.relabel(behind, kHere).empty());
}

TEST(MotionSegmentation, IsNotTheRimThatAnErrorOfThePoseGives) {
  MotionSegmentation movement({}, {});
  movement.remember(wall_with_thing(0.0, 60), kHere);
  for (const double error : {-0.06, -0.03, 0.03, 0.06}) {
    LabeledCloud cloud = wall_with_thing(0.5, 60);
    EXPECT_TRUE(movement.relabel(cloud, pose({error, 0, 0})).empty()) << error;
    EXPECT_TRUE(movement.relabel(cloud, pose({0, 0, 0}, error / 3.0)).empty()) << error;
  }
}

TEST(MotionSegmentation, OfNearlyAllIsAnErrorOfThePose) {
  LabeledCloud cloud = wall_with_thing(0.5);
  EXPECT_TRUE(after_a_view_of_the_wall().relabel(cloud, pose({0, 0, -0.6})).empty());
  EXPECT_EQ(dynamic_points(cloud), 0U);
}

TEST(MotionSegmentation, EndsSomeTimeAfterAThingCameToRest) {
  MotionSegmentation movement = after_a_view_of_the_wall({.memory = 2.0});
  for (const double seconds : {1.0, 1.9}) {
    LabeledCloud cloud = wall_with_thing(seconds, 60);
    EXPECT_FALSE(movement.relabel(cloud, kHere).empty()) << seconds;
    movement.remember(cloud, kHere);
  }
  movement.remember(wall_with_thing(2.5, 60), kHere);
  LabeledCloud cloud = wall_with_thing(2.6, 60);
  EXPECT_TRUE(movement.relabel(cloud, kHere).empty());
}

TEST(MotionSegmentation, IsNotToldByViewsOfLongAgo) {
  LabeledCloud cloud = wall_with_thing(2.1, 60);
  EXPECT_TRUE(after_a_view_of_the_wall({.memory = 2.0}).relabel(cloud, kHere).empty());
  EXPECT_EQ(dynamic_points(cloud), 0U);
}

TEST(MotionSegmentation, TakesInWhatHangsTogetherWithItBeforeSpaceWithoutReturns) {
  // The lower half of the wall gives returns; a component stands before both halves.
  const auto scene_at = [](double seconds, bool with_thing) {
    LabeledCloud cloud = organised_cloud([=](int x, int y, const Eigen::Vector3f&) {
      if (with_thing && x >= 60 && x < 100 && y >= 20 && y < 100) return 2.0F;
      return y >= 60 ? 3.0F : 0.0F;
    });
    cloud.stamp = at(seconds);
    return cloud;
  };
  MotionSegmentation movement({}, {});
  movement.remember(scene_at(0.0, false), kHere);
  LabeledCloud cloud = scene_at(0.5, true);
  movement.relabel(cloud, kHere);
  EXPECT_EQ(dynamic_points(cloud), 40U * 80U);
  // What was hidden or out of view may be anything.
  const LabeledCloud narrow = organised_cloud([](int x, int y, const Eigen::Vector3f&) {
    if (x >= 80) return 1.0F;  // hides what is behind
    return y >= 60 ? 3.0F : 0.0F;
  });
  MotionSegmentation other({}, {});
  other.remember(narrow, kHere);
  cloud = scene_at(0.5, true);
  other.relabel(cloud, kHere);
  for (int y = 20; y < 100; ++y) {
    EXPECT_EQ(cloud.labels[static_cast<std::size_t>(160 * y + 90)], PointLabel::kStatic) << y;
  }
}

TEST(MotionSegmentation, IsNotLookedForInScans) {
  LabeledCloud scan = wall_with_thing(0.5, 60);
  scan.width *= scan.height;
  scan.height = 1;
  EXPECT_TRUE(after_a_view_of_the_wall().relabel(scan, kHere).empty());
}

}  // namespace
}  // namespace mms
