#include "mms/mapping/motion_segmentation/motion_segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/mapping/synthetic_cloud.hpp"
#include "tests/mapping/synthetic_scan.hpp"

namespace mms {
namespace {

using test::dynamic_points;
using test::hall_scan;
using test::pose;
using test::StandingBox;

const Transform<World, Sensor> kHere = pose({0, 0, 0});

/// A person 1.7 m tall, 3 m to the left.
StandingBox person(double x = 0.0) {
  return {{x - 0.25, 2.8, -1.0}, {x + 0.25, 3.2, 0.7}};
}

LabeledCloud scan_at(double seconds, const std::vector<StandingBox>& boxes,
                     const Transform<World, Sensor>& T_world_sensor = kHere) {
  LabeledCloud cloud = hall_scan(boxes, T_world_sensor);
  cloud.stamp = Timestamp::from_seconds(seconds);
  return cloud;
}

/// Whether a point is within 15 cm of the box, the size of a voxel at its boundary included.
bool is_of(const StandingBox& box, const Eigen::Vector3d& point) {
  return ((point - box.low).array() > -0.15).all() && ((box.high - point).array() > -0.15).all();
}

std::size_t points_of(const StandingBox& box, const LabeledCloud& cloud) {
  return static_cast<std::size_t>(
      std::count_if(cloud.points.begin(), cloud.points.end(),
                    [&](const auto& p) { return is_of(box, p.template cast<double>()); }));
}

MotionSegmentation segmentation_of_hall(const std::vector<StandingBox>& boxes = {}) {
  MotionSegmentation segmentation({}, {});
  segmentation.remember(scan_at(0.0, boxes), kHere);
  return segmentation;
}

TEST(MotionSegmentationOfScans, LabelsPointsInFreeSpaceDynamic) {
  LabeledCloud cloud = scan_at(0.5, {person()});
  EXPECT_FALSE(segmentation_of_hall().relabel(cloud, kHere).empty());
  EXPECT_GT(dynamic_points(cloud), points_of(person(), cloud) * 7 / 10);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    EXPECT_EQ(cloud.labels[i] == PointLabel::kDynamic, cloud.cluster[i] == 0);
    if (cloud.labels[i] == PointLabel::kDynamic) {
      EXPECT_TRUE(is_of(person(), cloud.points[i].cast<double>()));
    }
  }
  ASSERT_EQ(cloud.clusters.size(), 1U);
  EXPECT_EQ(cloud.clusters[0].object_class, ObjectClass::kUnknown);
  EXPECT_EQ(cloud.clusters[0].points, static_cast<int>(dynamic_points(cloud)));
}

TEST(MotionSegmentationOfScans, WorksWithAMovingSensor) {
  const Transform<World, Sensor> T_world_sensor = pose({0.5, 0.2, 0});
  LabeledCloud cloud = scan_at(0.5, {person()}, T_world_sensor);
  segmentation_of_hall().relabel(cloud, T_world_sensor);
  EXPECT_GT(dynamic_points(cloud), 60U);
}

TEST(MotionSegmentationOfScans, KeepsKnownSurfacesStatic) {
  LabeledCloud cloud = scan_at(0.5, {person()});
  EXPECT_TRUE(segmentation_of_hall({person()}).relabel(cloud, kHere).empty());
  EXPECT_EQ(dynamic_points(cloud), 0U);
}

TEST(MotionSegmentationOfScans, KeepsDisoccludedSurfacesStatic) {
  // Occluded by a screen in the first scan, visible in the second.
  const StandingBox screen{{-1.5, 1.5, -1.0}, {0.4, 1.6, 4.0}};
  const Transform<World, Sensor> T_world_sensor = pose({1.2, 0.0, 0});
  LabeledCloud cloud = scan_at(0.5, {screen, person()}, T_world_sensor);
  EXPECT_TRUE(segmentation_of_hall({screen}).relabel(cloud, T_world_sensor).empty());
}

TEST(MotionSegmentationOfScans, AddsWhatAMaskOmitsToItsCluster) {
  LabeledCloud cloud = scan_at(0.5, {person()});
  cloud.clusters.emplace_back();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!is_of(person(), cloud.points[i].cast<double>()) || cloud.points[i].z() > 0.0F) continue;
    cloud.labels[i] = PointLabel::kDynamic;  // a mask of the legs
    cloud.cluster[i] = 0;
  }
  const std::size_t named = dynamic_points(cloud);
  EXPECT_FALSE(segmentation_of_hall().relabel(cloud, kHere).empty());
  EXPECT_EQ(cloud.clusters.size(), 1U);
  EXPECT_GT(dynamic_points(cloud), named + 20);
}

TEST(MotionSegmentationOfScans, KeepsLinesStatic) {
  // A cable between two rings, which only the second scan hits.
  const StandingBox cable{{-2.0, 2.9, 0.05}, {2.0, 2.93, 0.07}};
  LabeledCloud cloud = scan_at(0.5, {cable});
  ASSERT_GT(points_of(cable, cloud), 20U);
  EXPECT_TRUE(segmentation_of_hall().relabel(cloud, kHere).empty());
}

TEST(MotionSegmentationOfScans, LabelsFewPointsWithAWrongPose) {
  const Transform<World, Sensor> wrong = pose({0.6, 0.0, 0});
  LabeledCloud cloud = scan_at(0.5, {});
  segmentation_of_hall().relabel(cloud, wrong);
  EXPECT_LT(dynamic_points(cloud), cloud.points.size() / 50);
}

TEST(MotionSegmentationOfScans, IgnoresOldViews) {
  LabeledCloud cloud = scan_at(30.0, {person()});
  EXPECT_TRUE(segmentation_of_hall().relabel(cloud, kHere).empty());
}

TEST(MotionSegmentationOfScans, NeedsToBeEnabled) {
  MotionSegmentationConfig config;
  config.enabled = false;
  MotionSegmentation segmentation(config, {});
  segmentation.remember(scan_at(0.0, {}), kHere);
  LabeledCloud cloud = scan_at(0.5, {person()});
  EXPECT_TRUE(segmentation.relabel(cloud, kHere).empty());
}

}  // namespace
}  // namespace mms
