#include "mms/mapping/dynamic_map.hpp"

#include <gtest/gtest.h>

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
  OdometryEstimate odometry;
  odometry.stamp = cloud.stamp;
  odometry.T_world_sensor = Transform<World, Sensor>(T_world_sensor);
  map.update(cloud, odometry);
}

TEST(DynamicMap, MeasuresTheVelocityOfASteadyBoxFromAMovingCamera) {
  DynamicMap map;
  for (int i = 0; i < 30; ++i) {
    const double t = kPeriod * i;
    const Eigen::Isometry3d T(Eigen::Translation3d(0.3 * t, 0.0, 0.0) *
                              Eigen::AngleAxisd(0.2 * t, Eigen::Vector3d::UnitY()));
    const Eigen::Vector3d world(-1.0 + 1.1 * t, 0.0, 3.0 - 0.4 * t);
    give(map, i, {cluster_at((T.inverse() * world).cast<float>())}, T);
  }
  ASSERT_EQ(map.tracks().size(), 1U);
  const Track& track = map.tracks()[0];
  EXPECT_EQ(track.state, TrackState::kActive);
  EXPECT_EQ(track.history.size(), 30U);
  EXPECT_NEAR(track.velocity.x(), 1.1, 1e-3);
  EXPECT_NEAR(track.velocity.z(), -0.4, 1e-3);
  EXPECT_LT(track.history.back().box_min.x(), track.history.back().centroid.x());
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
  ASSERT_EQ(map.tracks().size(), 2U);
  EXPECT_EQ(map.tracks()[0].id, 1);
  EXPECT_GT(map.tracks()[0].velocity.x(), 0.9);
  EXPECT_EQ(map.tracks()[0].votes[0], 45);
  EXPECT_EQ(map.tracks()[1].votes[1], 45);
  EXPECT_LT(map.tracks()[1].velocity.x(), -0.9);
}

TEST(DynamicMap, CoastsBehindAPillarAndEndsAfterThat) {
  DynamicMap map;
  const auto at = [](int i) { return cluster_at({static_cast<float>(0.08 * i), 0.0F, 3.0F}); };
  for (int i = 0; i < 10; ++i) give(map, i, {at(i)});
  for (int i = 10; i < 22; ++i) give(map, i, {});
  ASSERT_EQ(map.active().size(), 1U);
  EXPECT_EQ(map.active()[0].state, TrackState::kCoasting);
  EXPECT_EQ(map.active()[0].history.size(), 1U);
  give(map, 22, {at(22)});
  EXPECT_EQ(map.tracks().size(), 1U);
  EXPECT_EQ(map.tracks()[0].state, TrackState::kActive);
  for (int i = 23; i < 45; ++i) give(map, i, {});
  EXPECT_TRUE(map.active().empty());
  ASSERT_EQ(map.tracks().size(), 1U);
  EXPECT_EQ(map.tracks()[0].state, TrackState::kEnded);
  give(map, 45, {at(45)});
  EXPECT_EQ(map.tracks().back().id, 2);
}

TEST(DynamicMap, DropsWhatWasSeenOnlyOnce) {
  DynamicMap map;
  give(map, 0, {cluster_at({0.0F, 0.0F, 2.0F})});
  ASSERT_EQ(map.tracks().size(), 1U);
  EXPECT_EQ(map.tracks()[0].state, TrackState::kTentative);
  EXPECT_TRUE(map.active().empty());
  for (int i = 1; i < 30; ++i) give(map, i, {});
  EXPECT_TRUE(map.tracks().empty());
}

TEST(DynamicMap, DoesNotLinkBeyondTheGate) {
  DynamicMap map;
  for (int i = 0; i < 5; ++i) give(map, i, {cluster_at({0.0F, 0.0F, 2.0F})});
  give(map, 5, {cluster_at({2.0F, 0.0F, 2.0F})});
  EXPECT_EQ(map.tracks().size(), 2U);
}

TEST(DynamicMap, TheClassIsWhatMostFramesSaw) {
  DynamicMap map;
  for (int i = 0; i < 9; ++i) {
    const auto seen = i % 3 == 0 ? ObjectClass::kPerson : ObjectClass::kAgv;
    give(map, i, {cluster_at({0.0F, 0.0F, 2.0F}, seen)});
  }
  EXPECT_EQ(map.tracks().at(0).object_class, ObjectClass::kAgv);
}

TEST(DynamicMap, IgnoresFramesOutOfOrder) {
  DynamicMap map;
  give(map, 3, {cluster_at({0.0F, 0.0F, 2.0F})});
  give(map, 3, {cluster_at({0.0F, 0.0F, 2.0F})});
  give(map, 1, {cluster_at({0.0F, 0.0F, 2.0F})});
  EXPECT_EQ(map.tracks().at(0).history.size(), 1U);
}

}  // namespace
}  // namespace mms
