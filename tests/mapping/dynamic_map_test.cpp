#include "mms/mapping/tracking/dynamic_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mms {
namespace {

constexpr double kPeriod = 1.0 / 15.0;  // [s]

DynamicCluster cluster_at(const Eigen::Vector3f& center,
                          ObjectClass object_class = ObjectClass::kPerson) {
  DynamicCluster cluster;
  cluster.object_class = object_class;
  cluster.centroid = center;
  cluster.box_min = center - Eigen::Vector3f(0.25F, 0.8F, 0.15F);
  cluster.box_max = center + Eigen::Vector3f(0.25F, 0.8F, 0.15F);
  return cluster;
}

/// Gives the map frame number `index` with those clusters, seen from a pose.
void give(DynamicMap& map, int index, const std::vector<DynamicCluster>& clusters,
          const Eigen::Isometry3d& T_world_sensor = Eigen::Isometry3d::Identity()) {
  LabeledCloud cloud;
  cloud.stamp = Timestamp::from_seconds(1.0 + kPeriod * index);
  cloud.clusters = clusters;
  cloud.width = 1;  // a camera's, whose y axis is down
  cloud.height = 2;
  cloud.points.assign(2, Eigen::Vector3f::Constant(NAN));
  cloud.labels.assign(2, PointLabel::kInvalid);
  cloud.cluster.assign(2, -1);
  OdometryEstimate odometry;
  odometry.stamp = cloud.stamp;
  odometry.T_world_sensor = Transform<World, Sensor>(T_world_sensor);
  map.update(cloud, odometry);
}

TEST(DynamicMap, MeasuresTheVelocityOfASteadyBoxFromAMovingCamera) {
  DynamicMap map;
  for (int i = 0; i < 60; ++i) {
    const double t = kPeriod * i;
    const Eigen::Isometry3d T(Eigen::Translation3d(0.3 * t, 0.0, 0.0) *
                              Eigen::AngleAxisd(0.2 * t, Eigen::Vector3d::UnitY()));
    const Eigen::Vector3d world(-1.0 + 1.1 * t, 0.0, 3.0 - 0.1 * t);
    give(map, i, {cluster_at((T.inverse() * world).cast<float>())}, T);
  }
  ASSERT_EQ(map.objects().size(), 1U);
  const TrackedObject object = map.objects()[0];
  EXPECT_EQ(object.state, TrackState::kActive);
  EXPECT_TRUE(object.box.moving);
  EXPECT_NEAR(object.box.velocity.x(), 1.1, 0.1);
  EXPECT_NEAR(object.box.velocity.z(), -0.1, 0.15);
  EXPECT_LT(object.motion.velocity_covariance().trace(), 0.3);
  // It faces where it goes.
  EXPECT_GT(object.box.T_world_box.linear().col(0).x(), 0.9);
  EXPECT_NEAR(object.box.T_world_box.linear().col(2).y(), -1.0, 1e-9);
}

TEST(DynamicMap, KeepsTheIdsOfTwoThatCross) {
  DynamicMap map;
  for (int i = 0; i < 45; ++i) {
    const auto t = static_cast<float>(kPeriod * i);
    // Clusters come in any order: here by side, so that it changes when they pass each other.
    const DynamicCluster right = cluster_at({-1.5F + t, 0.0F, 2.5F});
    const DynamicCluster left = cluster_at({1.5F - t, 0.0F, 3.1F}, ObjectClass::kAgv);
    i < 22 ? give(map, i, {right, left}) : give(map, i, {left, right});
  }
  ASSERT_EQ(map.objects().size(), 2U);
  EXPECT_EQ(map.objects()[0].box.id, 1);
  EXPECT_EQ(map.objects()[0].box.object_class, ObjectClass::kPerson);
  EXPECT_GT(map.objects()[0].box.velocity.x(), 0.9);
  EXPECT_EQ(map.objects()[1].box.object_class, ObjectClass::kAgv);
  EXPECT_LT(map.objects()[1].box.velocity.x(), -0.9);
  EXPECT_EQ(map.confirmed(), 2);
}

TEST(DynamicMap, CoastsBehindAPillarAndEndsAfterThat) {
  DynamicMap map;
  const auto at = [](int i) { return cluster_at({static_cast<float>(0.08 * i), 0.0F, 3.0F}); };
  for (int i = 0; i < 15; ++i) give(map, i, {at(i)});
  for (int i = 15; i < 20; ++i) give(map, i, {});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].state, TrackState::kCoasting);
  EXPECT_NEAR(map.objects()[0].box.center().x(), 0.08 * 19, 0.15);
  for (int i = 20; i < 32; ++i) give(map, i, {});
  EXPECT_TRUE(map.objects().empty());  // unseen for longer than objects are shown
  give(map, 32, {at(32)});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].box.id, 1);
  EXPECT_EQ(map.objects()[0].state, TrackState::kActive);
  for (int i = 33; i < 100; ++i) give(map, i, {});
  for (int i = 100; i < 105; ++i) give(map, i, {at(i)});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].box.id, 2);
}

/// What no mask named, but which moves.
DynamicCluster moving_at(const Eigen::Vector3f& center) {
  DynamicCluster cluster = cluster_at(center, ObjectClass::kUnknown);
  cluster.score = 0.0F;
  return cluster;
}

TEST(DynamicMap, WhatMovesWithoutAMaskIsAnObjectOfUnknownClass) {
  DynamicMap map;
  const auto at = [](int i) { return moving_at({static_cast<float>(0.07 * i), 0.0F, 3.0F}); };
  for (int i = 0; i < 9; ++i) give(map, i, {at(i)});
  EXPECT_TRUE(map.objects().empty());  // it may be an error of the pose
  for (int i = 9; i < 20; ++i) give(map, i, {at(i)});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].box.object_class, ObjectClass::kUnknown);
  EXPECT_TRUE(map.objects()[0].box.moving);
  EXPECT_NEAR(map.objects()[0].box.velocity.x(), 1.05, 0.2);
}

TEST(DynamicMap, ItGetsTheNameThatAMaskGives) {
  DynamicMap map;
  const auto place = [](int i) { return Eigen::Vector3f(static_cast<float>(0.07 * i), 0, 3); };
  for (int i = 0; i < 20; ++i) give(map, i, {moving_at(place(i))});
  for (int i = 20; i < 24; ++i) give(map, i, {cluster_at(place(i))});
  for (int i = 24; i < 40; ++i) give(map, i, {moving_at(place(i))});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].box.object_class, ObjectClass::kPerson);
  EXPECT_EQ(map.objects()[0].box.id, 1);
  EXPECT_EQ(map.objects()[0].state, TrackState::kActive);
}

TEST(DynamicMap, WhatMovesBesideAnObjectIsAPartOfIt) {
  DynamicMap map;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3f place(static_cast<float>(0.07 * i), 0, 3);
    DynamicCluster arm = moving_at(place + Eigen::Vector3f(0.4F, 0.0F, 0.0F));
    arm.box_min = arm.centroid.array() - 0.1F;
    arm.box_max = arm.centroid.array() + 0.1F;
    give(map, i, {cluster_at(place), arm});
  }
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.confirmed(), 1);
}

TEST(DynamicMap, OneThatStandsForTwentySecondsStaysTheSameObject) {
  DynamicMap map;
  for (int i = 0; i < 30; ++i) {
    give(map, i, {cluster_at({static_cast<float>(0.07 * i), 0.0F, 3.0F})});
  }
  EXPECT_TRUE(map.objects().at(0).box.moving);
  int recognised = -1;
  for (int i = 30; i < 330; ++i) {
    give(map, i, {cluster_at({static_cast<float>(0.07 * 29), 0.0F, 3.0F})});
    if (recognised < 0 && !map.objects().at(0).box.moving) recognised = i;
  }
  EXPECT_LT(kPeriod * (recognised - 30), 1.0);
  EXPECT_EQ(map.objects().at(0).box.id, 1);
  EXPECT_FALSE(map.objects()[0].box.moving);
  EXPECT_EQ(map.confirmed(), 1);
}

TEST(DynamicMap, DropsWhatWasSeenOnlyOnce) {
  DynamicMap map;
  give(map, 0, {cluster_at({0.0F, 0.0F, 2.0F})});
  for (int i = 1; i < 80; ++i) give(map, i, {});
  EXPECT_TRUE(map.objects().empty());
  EXPECT_EQ(map.confirmed(), 0);
}

TEST(DynamicMap, DoesNotLinkBeyondTheGate) {
  DynamicMap map;
  for (int i = 0; i < 5; ++i) give(map, i, {cluster_at({0.0F, 0.0F, 2.0F})});
  for (int i = 5; i < 10; ++i) give(map, i, {cluster_at({2.0F, 0.0F, 2.0F})});
  EXPECT_EQ(map.confirmed(), 2);
}

TEST(DynamicMap, TheClassIsWhatMostFramesSaw) {
  DynamicMap map;
  for (int i = 0; i < 9; ++i) {
    const auto seen = i % 3 == 0 ? ObjectClass::kPerson : ObjectClass::kAgv;
    give(map, i, {cluster_at({0.0F, 0.0F, 2.0F}, seen)});
  }
  EXPECT_EQ(map.objects().at(0).box.object_class, ObjectClass::kAgv);
}

TEST(DynamicMap, APieceOfAnObjectIsNoNewOne) {
  DynamicMap map;
  const DynamicCluster whole = cluster_at({0.0F, 0.0F, 2.0F});
  DynamicCluster foot = cluster_at({0.0F, 0.7F, 2.0F});
  foot.box_min = foot.centroid - Eigen::Vector3f::Constant(0.05F);
  foot.box_max = foot.centroid + Eigen::Vector3f::Constant(0.05F);
  for (int i = 0; i < 10; ++i) give(map, i, {whole});
  for (int i = 10; i < 20; ++i) give(map, i, {whole, foot});
  EXPECT_EQ(map.objects().size(), 1U);
}

TEST(DynamicMap, OneWhoJoinsAnotherAndLeavesIsTheSame) {
  DynamicMap map;
  // Two walk side by side, are one cluster for half a second, and part again.
  for (int i = 0; i < 40; ++i) {
    const auto x = static_cast<float>(0.06 * i);
    const DynamicCluster near = cluster_at({x, 0.0F, 2.5F});
    const DynamicCluster far = cluster_at({x, 0.0F, 3.1F});
    DynamicCluster both = cluster_at({x, 0.0F, 2.8F});
    both.box_min.z() = near.box_min.z();
    both.box_max.z() = far.box_max.z();
    i >= 20 && i < 27 ? give(map, i, {both}) : give(map, i, {near, far});
  }
  ASSERT_EQ(map.objects().size(), 2U);
  EXPECT_EQ(map.confirmed(), 2);
  EXPECT_LT(map.objects()[0].box.size.maxCoeff(), 1.8);
}

TEST(DynamicMap, WhatTheNetworkDoubtsIsNoObject) {
  DynamicMap map;
  DynamicCluster doubtful = cluster_at({0.0F, 0.0F, 2.0F});
  doubtful.score = 0.2F;
  for (int i = 0; i < 10; ++i) give(map, i, {doubtful});
  EXPECT_TRUE(map.objects().empty());
  doubtful.score = 0.9F;
  for (int i = 10; i < 15; ++i) give(map, i, {doubtful});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_NEAR(map.objects()[0].box.score, (10 * 0.2 + 5 * 0.9) / 15, 1e-6);
}

TEST(DynamicMap, WhatIsOnlyRememberedBeginsNoObjectButKeepsOne) {
  DynamicMap map;
  DynamicCluster remembered = cluster_at({0.0F, 0.0F, 2.0F});
  remembered.score = 0.0F;
  for (int i = 0; i < 10; ++i) give(map, i, {remembered});
  EXPECT_TRUE(map.objects().empty());
  for (int i = 10; i < 16; ++i) give(map, i, {cluster_at({0.0F, 0.0F, 2.0F})});
  for (int i = 16; i < 20; ++i) give(map, i, {remembered});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].state, TrackState::kActive);
  EXPECT_EQ(map.objects()[0].box.score, 1.0);
}

TEST(DynamicMap, WhatElseAMaskCoversIsNoObject) {
  DynamicMap map;
  DynamicCluster person = cluster_at({0.0F, 0.0F, 2.0F});
  DynamicCluster wall = cluster_at({0.5F, 0.0F, 4.0F});
  person.instance = wall.instance = 3;
  for (int i = 0; i < 10; ++i) give(map, i, {person, wall});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_LT(map.objects()[0].box.center().z(), 2.5);
}

TEST(DynamicMap, FollowsWhatItKnowsWhereAMaskCoversMoreOfSomethingElse) {
  DynamicMap map;
  DynamicCluster vehicle = cluster_at({0.0F, 0.0F, 3.0F}, ObjectClass::kAgv);
  DynamicCluster shelf = cluster_at({0.5F, 0.0F, 5.0F}, ObjectClass::kAgv);
  vehicle.instance = shelf.instance = 3;
  for (int i = 0; i < 10; ++i) give(map, i, {vehicle});
  for (int i = 10; i < 30; ++i) give(map, i, {shelf, vehicle});  // the largest comes first
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].state, TrackState::kActive);
  EXPECT_LT(map.objects()[0].box.center().z(), 3.5);
  EXPECT_EQ(map.confirmed(), 1);
}

TEST(DynamicMap, OneMaskKeepsOneObjectAlive) {
  DynamicMap map;
  DynamicCluster engine = cluster_at({0.0F, 0.0F, 3.0F}, ObjectClass::kAgv);
  DynamicCluster mast = cluster_at({0.0F, 0.0F, 4.2F}, ObjectClass::kAgv);
  engine.instance = 0;
  mast.instance = 1;
  for (int i = 0; i < 10; ++i) give(map, i, {engine, mast});
  EXPECT_EQ(map.objects().size(), 2U);
  mast.instance = 0;
  for (int i = 10; i < 40; ++i) give(map, i, {engine, mast});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_LT(map.objects()[0].box.center().z(), 3.5);
}

TEST(DynamicMap, AClusterWithoutPointsIsWhereItsBoxIsAndOneWithoutABoxIsNowhere) {
  DynamicMap map;
  DynamicCluster lost_points = cluster_at({0.0F, 0.0F, 3.0F});
  lost_points.centroid.setZero();
  DynamicCluster no_box = lost_points;
  no_box.box_min.setConstant(NAN);
  for (int i = 0; i < 10; ++i) give(map, i, {no_box, lost_points});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_NEAR(map.objects()[0].box.center().z(), 3.0, 0.3);
}

TEST(DynamicMap, IgnoresFramesOutOfOrder) {
  DynamicMap map;
  for (const int index : {3, 3, 1, 3}) give(map, index, {cluster_at({0.0F, 0.0F, 2.0F})});
  EXPECT_EQ(map.confirmed(), 0);
}

}  // namespace
}  // namespace mms
