#include "mms/mapping/motion_segmentation/scan_motion_segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/mapping/synthetic_cloud.hpp"
#include "tests/mapping/synthetic_scan.hpp"

namespace mms {
namespace {

using test::hall_scan;
using test::pose;
using test::StandingBox;

constexpr double kNoise = 0.02;

const Transform<World, Sensor> kHere = pose({0, 0, 0});

/// Somebody 1.7 m tall, 3 m to the left.
StandingBox somebody(double x = 0.0) {
  return {{x - 0.25, 2.8, -1.0}, {x + 0.25, 3.2, 0.7}};
}

LabeledCloud scan_at(double seconds, const std::vector<StandingBox>& boxes,
                     const Transform<World, Sensor>& T_world_sensor = kHere) {
  LabeledCloud cloud = hall_scan(boxes, T_world_sensor);
  cloud.stamp = Timestamp::from_seconds(seconds);
  return cloud;
}

std::size_t dynamic_points(const LabeledCloud& cloud) {
  return static_cast<std::size_t>(
      std::count(cloud.labels.begin(), cloud.labels.end(), PointLabel::kDynamic));
}

/// Points of the box, with some 15 cm about it for the voxels at its boundaries.
bool is_of(const StandingBox& box, const Eigen::Vector3d& point) {
  return ((point - box.low).array() > -0.15).all() && ((box.high - point).array() > -0.15).all();
}

std::size_t points_of(const StandingBox& box, const LabeledCloud& cloud) {
  return static_cast<std::size_t>(
      std::count_if(cloud.points.begin(), cloud.points.end(),
                    [&](const auto& p) { return is_of(box, p.template cast<double>()); }));
}

ScanMotionSegmentation after_a_view_of_the_hall(const std::vector<StandingBox>& boxes = {}) {
  ScanMotionSegmentation movement({}, kNoise);
  movement.remember(scan_at(0.0, boxes), kHere);
  return movement;
}

TEST(ScanMotionSegmentation, IsWhatStandsWhereSpaceWasFree) {
  LabeledCloud cloud = scan_at(0.5, {somebody()});
  EXPECT_TRUE(after_a_view_of_the_hall().relabel(cloud, kHere));
  EXPECT_GT(dynamic_points(cloud), points_of(somebody(), cloud) * 7 / 10);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    EXPECT_EQ(cloud.labels[i] == PointLabel::kDynamic, cloud.cluster[i] == 0);
    if (cloud.labels[i] == PointLabel::kDynamic) {
      EXPECT_TRUE(is_of(somebody(), cloud.points[i].cast<double>()));
    }
  }
  ASSERT_EQ(cloud.clusters.size(), 1U);
  EXPECT_EQ(cloud.clusters[0].object_class, ObjectClass::kUnknown);
  EXPECT_EQ(cloud.clusters[0].points, static_cast<int>(dynamic_points(cloud)));
}

TEST(ScanMotionSegmentation, IsFoundFromAnotherPlace) {
  const Transform<World, Sensor> T_world_sensor = pose({0.5, 0.2, 0});
  LabeledCloud cloud = scan_at(0.5, {somebody()}, T_world_sensor);
  after_a_view_of_the_hall().relabel(cloud, T_world_sensor);
  EXPECT_GT(dynamic_points(cloud), 60U);
}

TEST(ScanMotionSegmentation, WhatStoodThereBeforeIsNone) {
  LabeledCloud cloud = scan_at(0.5, {somebody()});
  EXPECT_FALSE(after_a_view_of_the_hall({somebody()}).relabel(cloud, kHere));
  EXPECT_EQ(dynamic_points(cloud), 0U);
}

TEST(ScanMotionSegmentation, WhatComesIntoViewIsNone) {
  // Behind a screen before, seen past it now.
  const StandingBox screen{{-1.5, 1.5, -1.0}, {0.4, 1.6, 4.0}};
  const Transform<World, Sensor> T_world_sensor = pose({1.2, 0.0, 0});
  LabeledCloud cloud = scan_at(0.5, {screen, somebody()}, T_world_sensor);
  EXPECT_FALSE(after_a_view_of_the_hall({screen}).relabel(cloud, T_world_sensor));
}

TEST(ScanMotionSegmentation, APartOfANamedThingBelongsToIt) {
  LabeledCloud cloud = scan_at(0.5, {somebody()});
  cloud.clusters.emplace_back();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!is_of(somebody(), cloud.points[i].cast<double>()) || cloud.points[i].z() > 0.0F) continue;
    cloud.labels[i] = PointLabel::kDynamic;  // a mask of the legs
    cloud.cluster[i] = 0;
  }
  const std::size_t named = dynamic_points(cloud);
  EXPECT_TRUE(after_a_view_of_the_hall().relabel(cloud, kHere));
  EXPECT_EQ(cloud.clusters.size(), 1U);
  EXPECT_GT(dynamic_points(cloud), named + 20);
}

TEST(ScanMotionSegmentation, LinesAreNone) {
  // A cable that hangs between two rings' heights before, and is hit now.
  const StandingBox cable{{-2.0, 2.9, 0.05}, {2.0, 2.93, 0.07}};
  LabeledCloud cloud = scan_at(0.5, {cable});
  ASSERT_GT(points_of(cable, cloud), 20U);
  EXPECT_FALSE(after_a_view_of_the_hall().relabel(cloud, kHere));
}

TEST(ScanMotionSegmentation, AWrongPoseMakesNoMovement) {
  const Transform<World, Sensor> wrong = pose({0.6, 0.0, 0});
  LabeledCloud cloud = scan_at(0.5, {});
  after_a_view_of_the_hall().relabel(cloud, wrong);
  EXPECT_LT(dynamic_points(cloud), cloud.points.size() / 50);
}

TEST(ScanMotionSegmentation, IsForgotten) {
  LabeledCloud cloud = scan_at(30.0, {somebody()});
  EXPECT_FALSE(after_a_view_of_the_hall().relabel(cloud, kHere));
}

TEST(ScanMotionSegmentation, CanBeSwitchedOff) {
  MotionSegmentationConfig config;
  config.enabled = false;
  ScanMotionSegmentation movement(config, kNoise);
  movement.remember(scan_at(0.0, {}), kHere);
  LabeledCloud cloud = scan_at(0.5, {somebody()});
  EXPECT_FALSE(movement.relabel(cloud, kHere));
}

}  // namespace
}  // namespace mms
