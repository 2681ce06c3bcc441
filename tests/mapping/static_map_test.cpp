#include "mms/mapping/static_map/static_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "tests/mapping/synthetic_cloud.hpp"
#include "tests/mapping/synthetic_scan.hpp"

namespace mms {
namespace {

using test::organised_cloud;
using test::plane_cloud;
using test::pose;

const Eigen::Vector3d kForward(0.0, 0.0, 1.0);

/// A wall at 3 m with a box 0.4 m wide in front of it.
LabeledCloud wall_with_ghost(float ghost_depth) {
  return organised_cloud(
      [=](int x, int, const Eigen::Vector3f&) { return x >= 60 && x < 100 ? ghost_depth : 3.0F; });
}

std::size_t points_before_wall(const StaticMap& map) {
  std::size_t count = 0;
  for (const Eigen::Vector3f& point : map.cloud().points) count += point.z() < 2.5F;
  return count;
}

TEST(StaticMap, PlaneFromSeveralPosesIsExact) {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.2, 1.0).normalized();
  StaticMap map;
  for (int i = 0; i < 5; ++i) {
    const auto T = pose({0.1 * i, -0.05 * i, 0.08 * i}, 0.05 * i);
    map.integrate(plane_cloud(normal, 2.0, T), T);
  }
  const MapCloud cloud = map.cloud();
  ASSERT_GT(cloud.size(), 5000U);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_NEAR(normal.dot(cloud.points[i].cast<double>()), 2.0, 1e-4);
    if (!cloud.normals[i].isZero()) {
      EXPECT_GT(cloud.normals[i].cast<double>().dot(-normal), 0.999);
    }
    EXPECT_EQ(cloud.colors[i], (Rgb{100, 150, 200}));
  }
}

TEST(StaticMap, CountsKeyframesAsObservations) {
  StaticMap map({.voxel_size = 0.5});
  const LabeledCloud cloud = plane_cloud(kForward, 2.1, pose({0, 0, 0}));
  for (int i = 0; i < 3; ++i) map.integrate(cloud, pose({0, 0, 0}));
  for (const int observations : map.cloud().observations) EXPECT_EQ(observations, 3);
  EXPECT_EQ(map.views(), 3U);
}

TEST(StaticMap, CorrectionMovesAndMergesTheSurfaceOfASecondVisit) {
  StaticMap map({.carving = {.enabled = false}});
  const auto visit = [&](double drift, std::int64_t stamp) {
    // The wall is measured at the drifted pose as if there were no drift.
    LabeledCloud cloud = plane_cloud({0, 0, -1}, -2.0, pose({0, 0, 0}));
    cloud.stamp = Timestamp(stamp);
    for (int i = 0; i < 3; ++i) map.integrate(cloud, pose({0, 0, drift}));
  };
  visit(0.0, 10);
  const std::size_t once = map.cloud().size();
  visit(0.05, 20);
  ASSERT_GT(map.cloud().size(), once * 3 / 2);
  const auto correction = [](Timestamp stamp) {
    return pose({0, 0, stamp == Timestamp(20) ? -0.05 : 0.0}).isometry();
  };
  const MapCloud corrected = merged(moved(map.cloud(), map.stamps(), correction), map.voxel_size());
  EXPECT_LT(corrected.size(), once * 11 / 10);
  for (const Eigen::Vector3f& point : corrected.points) EXPECT_NEAR(point.z(), 2.0F, 1e-3F);
}

TEST(StaticMap, HidesSingleObservationsInReobservedBlocks) {
  StaticMap map({.carving = {.enabled = false}});
  const LabeledCloud wall = plane_cloud(kForward, 2.01, pose({0, 0, 0}));
  map.integrate(wall, pose({0, 0, 0}));
  EXPECT_EQ(map.cloud().size(), map.size());
  const auto other_pose = pose({0, 0, 0}, 3.0);
  map.integrate(plane_cloud({0, 0, -1}, 2.0, other_pose), other_pose);
  EXPECT_EQ(map.cloud().size(), map.size());
  // The same blocks, observed again two voxels behind: single observations are hidden.
  const LabeledCloud behind = plane_cloud(kForward, 2.05, pose({0, 0, 0}));
  for (int i = 0; i < 8; ++i) map.integrate(behind, pose({0, 0, 0}));
  EXPECT_EQ(map.cloud().size(), map.size()) << "nine observations, with two needed";
  for (int i = 0; i < 2; ++i) map.integrate(behind, pose({0, 0, 0}));
  EXPECT_LT(map.cloud().size(), map.size());
}

/// A wall at 3 m with returns in every other group of four columns.
LabeledCloud striped_wall(int first_column) {
  return organised_cloud([=](int x, int, const Eigen::Vector3f&) {
    return (x / 4) % 2 == first_column ? 3.0F : 0.0F;
  });
}

TEST(StaticMap, FramesBetweenKeyframesFillHoles) {
  StaticMap map;
  map.integrate(striped_wall(0), pose({0, 0, 0}));
  const std::size_t before = map.cloud().size();
  EXPECT_GT(map.add(striped_wall(1), pose({0, 0, 0})), 1000U);
  EXPECT_GT(map.cloud().size(), before + before / 2);
  EXPECT_EQ(map.views(), 1U);
  for (const Eigen::Vector3f& normal : map.cloud().normals) EXPECT_LT(normal.z(), 0.1F);
}

TEST(StaticMap, FramesUpToKeyframeAreOneObservation) {
  StaticMap map({.voxel_size = 0.5});
  const LabeledCloud cloud = plane_cloud(kForward, 2.1, pose({0, 0, 0}));
  for (int observation = 0; observation < 3; ++observation) {
    for (int i = 0; i < 4; ++i) map.add(cloud, pose({0, 0, 0}));
    map.integrate(cloud, pose({0, 0, 0}));
  }
  for (const int observations : map.cloud().observations) EXPECT_EQ(observations, 3);
}

/// A scan of `count` points, 1 m apart along x, from 3 m on.
LabeledCloud small_scan(int count) {
  LabeledCloud cloud;
  for (int i = 0; i < count; ++i) cloud.points.emplace_back(3.0F + static_cast<float>(i), 0, 0);
  cloud.width = count;
  cloud.height = 1;
  cloud.labels.assign(cloud.points.size(), PointLabel::kStatic);
  cloud.cluster.assign(cloud.points.size(), -1);
  return cloud;
}

TEST(StaticMap, LongRunsKeepNeededViewpoints) {
  StaticMap map({.carving = {.enabled = false}});
  map.integrate(small_scan(3), pose({0, 0, 0}));
  for (int i = 0; i < 9000; ++i) map.integrate(small_scan(1), pose({0, 0, 0}));
  map.add(small_scan(2), pose({0, 0, 0.25}));
  EXPECT_EQ(map.cloud().size(), 5U);
  EXPECT_TRUE(map.finalize());
  EXPECT_EQ(map.changes().viewpoint.z(), 0.25F);
}

TEST(StaticMap, KeyframeCarvesPointsOfFrameBefore) {
  StaticMap map({.min_observations = 1});
  map.add(wall_with_ghost(1.5F), pose({0, 0, 0}));
  EXPECT_GT(map.integrate(wall_with_ghost(3.0F), pose({0, 0, 0})).carved, 1000U);
  EXPECT_LT(points_before_wall(map), 100U);
}

TEST(StaticMap, FrameWithoutPoseAddsNothing) {
  StaticMap map;
  const Transform<World, Sensor> invalid_pose(
      Eigen::Isometry3d(Eigen::Translation3d(NAN, 0.0, 0.0)));
  EXPECT_EQ(map.add(wall_with_ghost(1.5F), invalid_pose), 0U);
  EXPECT_EQ(map.size(), 0U);
}

/// Share of a wall's voxels in the cloud, where some were observed once and others 29 times.
double share_shown(const DepthNoise& noise) {
  StaticMapConfig config;
  config.carving.enabled = false;
  config.surface.noise.depth = noise;
  StaticMap map(config);
  for (int i = 0; i < 30; ++i) {
    const double depth = i == 0 ? 4.01 : 4.05;
    map.integrate(plane_cloud(kForward, depth, pose({0, 0, 0})), pose({0, 0, 0}));
  }
  return static_cast<double>(map.cloud().size()) / static_cast<double>(map.size());
}

TEST(StaticMap, HighNoiseNeedsNoSecondObservation) {
  const DepthNoise low_noise{.base = 0.001, .quadratic = 0.0};
  const DepthNoise high_noise{.base = 0.001, .quadratic = 0.02};
  EXPECT_LT(share_shown(low_noise), 0.9);
  EXPECT_EQ(share_shown(high_noise), 1.0);
}

TEST(StaticMap, CarvesGhostNotWall) {
  StaticMap map({.min_observations = 1});
  map.integrate(wall_with_ghost(1.5F), pose({0, 0, 0}));
  ASSERT_GT(points_before_wall(map), 1000U);
  std::size_t carved = 0;
  for (int i = 0; i < 3; ++i) {
    carved += map.integrate(wall_with_ghost(3.0F), pose({0, 0, 0})).carved;
  }
  EXPECT_GT(carved, 1000U);
  EXPECT_LT(points_before_wall(map), 100U);  // its boundary in the image's outermost pixels
  EXPECT_EQ(map.size(), map.cloud().size());
}

TEST(StaticMap, CarvesSoonWhatStoodForLong) {
  StaticMap map({.min_observations = 1});
  for (int i = 0; i < 100; ++i) map.integrate(wall_with_ghost(1.5F), pose({0, 0, 0}));
  ASSERT_GT(points_before_wall(map), 1000U);
  for (int i = 0; i < 26; ++i) map.integrate(wall_with_ghost(3.0F), pose({0, 0, 0}));
  EXPECT_LT(points_before_wall(map), 100U);
}

TEST(StaticMap, KeepsHiddenAndHitVoxels) {
  StaticMap map({.min_observations = 1});
  map.integrate(wall_with_ghost(3.0F), pose({0, 0, 0}));
  const std::size_t before = map.size();
  std::size_t carved = 0;
  for (int i = 0; i < 5; ++i) {
    carved += map.integrate(wall_with_ghost(1.5F), pose({0, 0, 0})).carved;
  }
  EXPECT_EQ(carved, 0U);
  EXPECT_GT(map.size(), before);
}

TEST(StaticMap, DynamicPointsBehindCarve) {
  StaticMap map({.min_observations = 1});
  map.integrate(wall_with_ghost(1.5F), pose({0, 0, 0}));
  LabeledCloud behind = wall_with_ghost(2.5F);
  for (PointLabel& label : behind.labels) label = PointLabel::kDynamic;
  for (int i = 0; i < 3; ++i) map.integrate(behind, pose({0, 0, 0}));
  EXPECT_LT(points_before_wall(map), 100U);
}

TEST(StaticMap, DepthWithHolesDoesNotCarve) {
  StaticMap map({.min_observations = 1});
  map.integrate(wall_with_ghost(1.5F), pose({0, 0, 0}));
  const std::size_t ghost = points_before_wall(map);
  const LabeledCloud holes = organised_cloud(
      [](int x, int y, const Eigen::Vector3f&) { return x % 2 == 0 && y % 2 == 0 ? 0.0F : 3.0F; });
  for (int i = 0; i < 5; ++i) EXPECT_EQ(map.integrate(holes, pose({0, 0, 0})).carved, 0U);
  EXPECT_EQ(points_before_wall(map), ghost);
}

TEST(StaticMap, DoesNotCarveWhenDisabled) {
  StaticMapConfig config;
  config.carving.enabled = false;
  StaticMap map(config);
  map.integrate(wall_with_ghost(1.5F), pose({0, 0, 0}));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(map.integrate(wall_with_ghost(3.0F), pose({0, 0, 0})).carved, 0U);
  }
}

TEST(StaticMap, ScansCarveOnlyDepartedPerson) {
  const test::StandingBox person{{3.8, -0.25, -1.0}, {4.2, 0.25, 0.75}};
  StaticMap map({.scan_voxel_share = 0.0, .min_observations = 1});
  StaticMap uncarved(
      {.scan_voxel_share = 0.0, .min_observations = 1, .carving = {.enabled = false}});
  for (int i = 0; i < 12; ++i) {
    const auto T = pose({0.05 * i, 0.02 * i, 0.0}, 0.01 * i);
    const auto boxes = i < 2 ? std::vector{person} : std::vector<test::StandingBox>{};
    const LabeledCloud scan = test::hall_scan(boxes, T);
    map.integrate(scan, T);
    uncarved.integrate(scan, T);
  }
  const Eigen::AlignedBox3d volume(person.low + Eigen::Vector3d(-0.05, -0.05, 0.05),
                                   person.high.array() + 0.05);
  const auto count = [&](const StaticMap& m) {
    const std::vector<Eigen::Vector3f> points = m.cloud().points;
    return std::count_if(points.begin(), points.end(),
                         [&](const auto& p) { return volume.contains(p.template cast<double>()); });
  };
  EXPECT_GT(count(uncarved), 300);
  EXPECT_LT(count(map), 0.1 * static_cast<double>(count(uncarved)));
  EXPECT_EQ(static_cast<long>(uncarved.size() - map.size()), count(uncarved) - count(map));
}

TEST(StaticMap, ScansLeaveOutWhoComesUntilTheyStay) {
  const test::StandingBox person{{3.8, -0.25, -1.0}, {4.2, 0.25, 0.75}};
  const auto T = pose({0.0, 0.0, 0.0});
  StaticMap map({.scan_voxel_share = 0.0, .min_observations = 1});
  StaticMap uncarved(
      {.scan_voxel_share = 0.0, .min_observations = 1, .carving = {.enabled = false}});
  // Below, the rings hit the floor.
  const Eigen::AlignedBox3d volume(person.low + Eigen::Vector3d(-0.05, -0.05, 0.4),
                                   person.high.array() + 0.05);
  const auto count = [&](const StaticMap& m) {
    const std::vector<Eigen::Vector3f> points = m.cloud().points;
    return std::count_if(points.begin(), points.end(),
                         [&](const auto& p) { return volume.contains(p.template cast<double>()); });
  };
  for (int i = 0; i < 15; ++i) {
    const auto boxes = i < 6 ? std::vector<test::StandingBox>{} : std::vector{person};
    LabeledCloud scan = test::hall_scan(boxes, T);
    scan.stamp = Timestamp::from_seconds(0.5 * i);
    map.integrate(scan, T);
    uncarved.integrate(scan, T);
    if (i == 6) {
      EXPECT_GT(count(uncarved), 50);
      EXPECT_LT(count(map), 0.1 * static_cast<double>(count(uncarved)));
    }
  }
  EXPECT_EQ(count(map), count(uncarved));
  EXPECT_EQ(map.size(), uncarved.size());
}

TEST(StaticMap, DoublesVoxelSizeAtMemoryLimit) {
  StaticMap whole;
  StaticMap bounded({.memory = 1.0});
  bool coarsened = false;
  for (int i = 0; i < 10; ++i) {
    const auto T = pose({2.0 * i, 0.0, 0.0});
    const LabeledCloud cloud = plane_cloud(kForward, 2.0, T);
    whole.integrate(cloud, T);
    coarsened |= bounded.integrate(cloud, T).coarsened;
    EXPECT_LE(bounded.memory_bytes(), 1000000U);
  }
  EXPECT_TRUE(coarsened);
  EXPECT_GT(bounded.voxel_size(), whole.voxel_size());
  VoxelGrid voxels(bounded.voxel_size());
  for (const Eigen::Vector3f& point : bounded.cloud().points) {
    EXPECT_NEAR(point.z(), 2.0F, 1e-4F);
    voxels.at(point);
  }
  const auto inverse = static_cast<float>(1.0 / bounded.voxel_size());
  for (const Eigen::Vector3f& point : whole.cloud().points) {
    const VoxelKey key = voxel_key(point, inverse);
    bool found = false;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy)
        found |= voxels.find({key.x + dx, key.y + dy, key.z}) != nullptr;
    }
    EXPECT_TRUE(found) << point.transpose();
  }
}

TEST(StaticMap, ScanNormalsComeFromNeighborhood) {
  LabeledCloud scan;
  for (int i = 0; i < 400; ++i) {
    scan.points.emplace_back(0.1F * static_cast<float>(i % 20), 0.1F * static_cast<float>(i / 20),
                             5.03F);
  }
  scan.height = 1;
  scan.width = 400;
  scan.labels.assign(400, PointLabel::kStatic);
  StaticMap map({.voxel_size = 0.1});
  map.integrate(scan, pose({0, 0, 0}));
  const MapCloud cloud = map.cloud();
  ASSERT_GT(cloud.size(), 300U);
  for (const Eigen::Vector3f& normal : cloud.normals) EXPECT_NEAR(normal.z(), -1.0F, 1e-3F);
  EXPECT_EQ(cloud.colors[0], (Rgb{128, 128, 128}));
}

TEST(StaticMap, IgnoresNonFinitePose) {
  StaticMap map;
  const LabeledCloud cloud = plane_cloud(kForward, 2.0, pose({0, 0, 0}));
  EXPECT_EQ(map.integrate(cloud, pose({NAN, 0, 0})).points, 0U);
  EXPECT_EQ(map.size(), 0U);
  EXPECT_EQ(map.cloud().size(), 0U);
}

TEST(StaticMap, VoxelsOfScansFollowMedianRange) {
  StaticMapConfig config;
  config.voxel_size = 0.02;
  config.scan_voxel_share = 0.01;
  StaticMap map(config);
  map.integrate(small_scan(9), pose({0, 0, 0}));  // median range: 7 m
  EXPECT_NEAR(map.voxel_size(), 0.07, 1e-6);
  EXPECT_TRUE(map.changes().whole);
  map.integrate(small_scan(3), pose({0, 0, 0}));
  EXPECT_NEAR(map.voxel_size(), 0.07, 1e-6);
  EXPECT_FALSE(map.changes().whole);
  config.scan_voxel_share = 0.0;
  StaticMap fine(config);
  fine.integrate(small_scan(9), pose({0, 0, 0}));
  EXPECT_EQ(fine.voxel_size(), 0.02);
}

}  // namespace
}  // namespace mms
