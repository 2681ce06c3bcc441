#include "mms/mapping/motion_segmentation/motion_segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/mapping/synthetic_cloud.hpp"

namespace mms {
namespace {

using test::dynamic_points;
using test::organised_cloud;
using test::pose;

constexpr std::size_t kComponent = 40 * 60;  // pixels

Timestamp at(double seconds) {
  return Timestamp(static_cast<std::int64_t>(1e9 * seconds));
}

/// A wall at 3 m and, from pixel column `left` on, a box 0.6 m wide at 2 m in front of it.
LabeledCloud wall_with_box(double seconds, int left = -1000, float depth = 2.0F) {
  LabeledCloud cloud = organised_cloud([=](int x, int y, const Eigen::Vector3f&) {
    return x >= left && x < left + 40 && y >= 30 && y < 90 ? depth : 3.0F;
  });
  cloud.stamp = at(seconds);
  return cloud;
}

const Transform<World, Sensor> kHere = pose({0, 0, 0});

MotionSegmentation segmentation_of_wall(const MotionSegmentationConfig& config = {}) {
  MotionSegmentation segmentation(config, {});
  segmentation.remember(wall_with_box(0.0), kHere);
  return segmentation;
}

TEST(MotionSegmentation, LabelsPointsInFreeSpaceDynamic) {
  LabeledCloud cloud = wall_with_box(0.5, 60);
  const Image<std::uint8_t> moved = segmentation_of_wall().relabel(cloud, kHere);
  EXPECT_EQ(dynamic_points(cloud), kComponent);
  ASSERT_FALSE(moved.empty());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_EQ(moved[i] != 0, cloud.labels[i] == PointLabel::kDynamic);
    EXPECT_EQ(cloud.dynamic_pixels[i], moved[i]);
    EXPECT_EQ(moved[i] != 0, cloud.points[i].z() == 2.0F);
  }
}

TEST(MotionSegmentation, AddsAClusterOfUnknownClass) {
  LabeledCloud cloud = wall_with_box(0.5, 60);
  segmentation_of_wall().relabel(cloud, kHere);
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

/// Assigns the points of the box in the rows [low, high) to a person.
void assign_rows_to_person(LabeledCloud& cloud, int low, int high) {
  cloud.clusters.emplace_back().points = 40 * (high - low);
  for (int y = low; y < high; ++y) {
    for (int x = 60; x < 100; ++x) {
      const auto i = static_cast<std::size_t>(160 * y + x);
      cloud.labels[i] = PointLabel::kDynamic;
      cloud.cluster[i] = 0;
    }
  }
}

TEST(MotionSegmentation, AddsWhatAMaskOmitsToItsCluster) {
  LabeledCloud cloud = wall_with_box(0.5, 60);
  assign_rows_to_person(cloud, 30, 60);
  EXPECT_FALSE(segmentation_of_wall().relabel(cloud, kHere).empty());
  ASSERT_EQ(cloud.clusters.size(), 1U);
  EXPECT_EQ(cloud.clusters[0].object_class, ObjectClass::kPerson);
  EXPECT_EQ(cloud.clusters[0].points, static_cast<int>(kComponent));
  EXPECT_EQ(std::count(cloud.cluster.begin(), cloud.cluster.end(), 0),
            static_cast<std::ptrdiff_t>(kComponent));
}

/// Assigns the box to a person except the 4 columns at its right, too few for a core.
void assign_all_but_a_strip(LabeledCloud& cloud) {
  assign_rows_to_person(cloud, 30, 90);
  for (int y = 30; y < 90; ++y) {
    for (int x = 96; x < 100; ++x) {
      const auto i = static_cast<std::size_t>(160 * y + x);
      cloud.labels[i] = PointLabel::kStatic;
      cloud.cluster[i] = -1;
    }
  }
  cloud.clusters[0].points = 36 * 60;
}

TEST(MotionSegmentation, AddsAThinStripToTheAdjoiningCluster) {
  LabeledCloud cloud = wall_with_box(0.5, 60);
  assign_all_but_a_strip(cloud);
  EXPECT_FALSE(segmentation_of_wall().relabel(cloud, kHere).empty());
  EXPECT_EQ(dynamic_points(cloud), kComponent);
  ASSERT_EQ(cloud.clusters.size(), 1U);
  EXPECT_EQ(cloud.clusters[0].points, static_cast<int>(kComponent));
}

TEST(MotionSegmentation, KeepsAThinStripAtAnotherDepthStatic) {
  LabeledCloud cloud = wall_with_box(0.5, 60);
  assign_all_but_a_strip(cloud);
  for (int y = 30; y < 90; ++y) {
    for (int x = 96; x < 100; ++x) cloud.points[static_cast<std::size_t>(160 * y + x)] *= 0.8F;
  }
  segmentation_of_wall().relabel(cloud, kHere);
  EXPECT_EQ(dynamic_points(cloud), std::size_t{36 * 60});
}

TEST(MotionSegmentation, SeparatesObjectsAtDifferentDepths) {
  LabeledCloud cloud = wall_with_box(0.5, 60);
  assign_rows_to_person(cloud, 30, 60);
  for (int y = 60; y < 90; ++y) {
    for (int x = 60; x < 100; ++x) cloud.points[static_cast<std::size_t>(160 * y + x)] *= 0.8F;
  }
  EXPECT_FALSE(segmentation_of_wall().relabel(cloud, kHere).empty());
  ASSERT_EQ(cloud.clusters.size(), 2U);
  EXPECT_EQ(cloud.clusters[1].object_class, ObjectClass::kUnknown);
}

TEST(MotionSegmentation, WorksWithAMovingCamera) {
  // Half a metre nearer to both.
  LabeledCloud cloud = organised_cloud([](int x, int y, const Eigen::Vector3f&) {
    return x >= 60 && x < 100 && y >= 30 && y < 90 ? 1.5F : 2.5F;
  });
  segmentation_of_wall().relabel(cloud, pose({0, 0, 0.5}));
  EXPECT_EQ(dynamic_points(cloud), kComponent);
}

TEST(MotionSegmentation, NeedsAPreviousViewAndToBeEnabled) {
  LabeledCloud cloud = wall_with_box(0.5, 60);
  EXPECT_TRUE(MotionSegmentation({}, {}).relabel(cloud, kHere).empty());
  EXPECT_TRUE(segmentation_of_wall({.enabled = false}).relabel(cloud, kHere).empty());
  EXPECT_EQ(dynamic_points(cloud), 0U);
}

TEST(MotionSegmentation, KeepsKnownAndOccludedSurfacesStatic) {
  MotionSegmentation segmentation({}, {});
  segmentation.remember(wall_with_box(0.0, 60), kHere);
  LabeledCloud standing = wall_with_box(0.5, 60);
  EXPECT_TRUE(segmentation.relabel(standing, kHere).empty());
  LabeledCloud behind = wall_with_box(0.5, 60, 2.5F);
  EXPECT_TRUE(segmentation.relabel(behind, kHere).empty());
}

TEST(MotionSegmentation, KeepsBoundariesShiftedByAPoseErrorStatic) {
  MotionSegmentation segmentation({}, {});
  segmentation.remember(wall_with_box(0.0, 60), kHere);
  for (const double error : {-0.06, -0.03, 0.03, 0.06}) {
    LabeledCloud cloud = wall_with_box(0.5, 60);
    EXPECT_TRUE(segmentation.relabel(cloud, pose({error, 0, 0})).empty()) << error;
    EXPECT_TRUE(segmentation.relabel(cloud, pose({0, 0, 0}, error / 3.0)).empty()) << error;
  }
}

TEST(MotionSegmentation, RejectsAFrameMostlyInFreeSpace) {
  LabeledCloud cloud = wall_with_box(0.5);
  EXPECT_TRUE(segmentation_of_wall().relabel(cloud, pose({0, 0, -0.6})).empty());
  EXPECT_EQ(dynamic_points(cloud), 0U);
}

TEST(MotionSegmentation, EndsAfterAnObjectStops) {
  MotionSegmentation segmentation = segmentation_of_wall({.memory = 2.0});
  for (const double seconds : {1.0, 1.9}) {
    LabeledCloud cloud = wall_with_box(seconds, 60);
    EXPECT_FALSE(segmentation.relabel(cloud, kHere).empty()) << seconds;
    segmentation.remember(cloud, kHere);
  }
  segmentation.remember(wall_with_box(2.5, 60), kHere);
  LabeledCloud cloud = wall_with_box(2.6, 60);
  EXPECT_TRUE(segmentation.relabel(cloud, kHere).empty());
}

TEST(MotionSegmentation, IgnoresOldViews) {
  LabeledCloud cloud = wall_with_box(2.1, 60);
  EXPECT_TRUE(segmentation_of_wall({.memory = 2.0}).relabel(cloud, kHere).empty());
  EXPECT_EQ(dynamic_points(cloud), 0U);
}

TEST(MotionSegmentation, ExtendsComponentsIntoSpaceWithoutReturns) {
  // Only the lower half of the wall has returns; the box is in front of both halves.
  const auto scene_at = [](double seconds, bool with_box) {
    LabeledCloud cloud = organised_cloud([=](int x, int y, const Eigen::Vector3f&) {
      if (with_box && x >= 60 && x < 100 && y >= 20 && y < 100) return 2.0F;
      return y >= 60 ? 3.0F : 0.0F;
    });
    cloud.stamp = at(seconds);
    return cloud;
  };
  MotionSegmentation segmentation({}, {});
  segmentation.remember(scene_at(0.0, false), kHere);
  LabeledCloud cloud = scene_at(0.5, true);
  segmentation.relabel(cloud, kHere);
  EXPECT_EQ(dynamic_points(cloud), 40U * 80U);
  // Occluded space and space out of view are unknown.
  const LabeledCloud narrow = organised_cloud([](int x, int y, const Eigen::Vector3f&) {
    if (x >= 80) return 1.0F;  // an occluder
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

}  // namespace
}  // namespace mms
