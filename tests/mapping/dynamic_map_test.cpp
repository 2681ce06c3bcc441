#include "mms/mapping/tracking/dynamic_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "tests/mapping/synthetic_room.hpp"

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

/// Sets the corners of the clusters' boxes as their points, each cluster's in a row of its own.
/// Empty pixels around the rows keep them from being truncated. A cluster without a box has no
/// points.
void set_points(LabeledCloud& cloud) {
  constexpr int kCorners = 8;
  constexpr int kMargin = 5;
  cloud.width = kCorners + 2 * kMargin;  // a camera's, whose y axis is down
  cloud.height = kMargin * (static_cast<int>(cloud.clusters.size()) + 1);
  const auto size = static_cast<std::size_t>(cloud.width * cloud.height);
  cloud.points.assign(size, Eigen::Vector3f::Constant(NAN));
  cloud.labels.assign(size, PointLabel::kInvalid);
  cloud.cluster.assign(size, -1);
  for (std::size_t c = 0; c < cloud.clusters.size(); ++c) {
    const DynamicCluster& cluster = cloud.clusters[c];
    if (!cluster.box_min.allFinite()) continue;
    const std::size_t first = kMargin * ((c + 1) * static_cast<std::size_t>(cloud.width) + 1);
    for (std::size_t i = 0; i < kCorners; ++i) {
      const Eigen::Array3f high(static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                                static_cast<float>(i >> 2));
      cloud.points[first + i] =
          cluster.box_min.array() + high * (cluster.box_max - cluster.box_min).array();
      cloud.labels[first + i] = PointLabel::kDynamic;
      cloud.cluster[first + i] = static_cast<std::int16_t>(c);
    }
  }
}

/// Updates the map with frame `index`: those clusters, observed from that pose.
/// @param overruled  whether recent views contradict the masks
void update(DynamicMap& map, int index, const std::vector<DynamicCluster>& clusters,
            const Eigen::Isometry3d& T_world_sensor = Eigen::Isometry3d::Identity(),
            bool overruled = false) {
  LabeledCloud cloud;
  cloud.stamp = Timestamp::from_seconds(1.0 + kPeriod * index);
  cloud.clusters = clusters;
  set_points(cloud);
  if (overruled) cloud.overruled = Image<std::uint8_t>(cloud.width, cloud.height, 1);
  OdometryEstimate odometry;
  odometry.stamp = cloud.stamp;
  odometry.T_world_sensor = Transform<World, Sensor>(T_world_sensor);
  map.update(cloud, odometry);
}

TEST(DynamicMap, MeasuresVelocityFromMovingCamera) {
  DynamicMap map;
  for (int i = 0; i < 60; ++i) {
    const double t = kPeriod * i;
    const Eigen::Isometry3d T(Eigen::Translation3d(0.3 * t, 0.0, 0.0) *
                              Eigen::AngleAxisd(0.2 * t, Eigen::Vector3d::UnitY()));
    const Eigen::Vector3d world(-1.0 + 1.1 * t, 0.0, 3.0 - 0.1 * t);
    update(map, i, {cluster_at((T.inverse() * world).cast<float>())}, T);
  }
  ASSERT_EQ(map.objects().size(), 1U);
  const TrackedObject object = map.objects()[0];
  EXPECT_EQ(object.state, TrackState::kActive);
  EXPECT_TRUE(object.box.moving);
  EXPECT_NEAR(object.box.velocity.x(), 1.1, 0.1);
  EXPECT_NEAR(object.box.velocity.z(), -0.1, 0.15);
  EXPECT_LT(object.motion.velocity_covariance().trace(), 0.3);
  // It faces its direction of motion.
  EXPECT_GT(object.box.T_world_box.linear().col(0).x(), 0.9);
  EXPECT_NEAR(object.box.T_world_box.linear().col(2).y(), -1.0, 1e-9);
}

TEST(DynamicMap, KeepsIdsOfCrossingObjects) {
  DynamicMap map;
  for (int i = 0; i < 45; ++i) {
    const auto t = static_cast<float>(kPeriod * i);
    // The order of clusters changes when they pass each other.
    const DynamicCluster right = cluster_at({-1.5F + t, 0.0F, 2.5F});
    const DynamicCluster left = cluster_at({1.5F - t, 0.0F, 3.1F}, ObjectClass::kAgv);
    i < 22 ? update(map, i, {right, left}) : update(map, i, {left, right});
  }
  ASSERT_EQ(map.objects().size(), 2U);
  EXPECT_EQ(map.objects()[0].box.id, 1);
  EXPECT_EQ(map.objects()[0].box.object_class, ObjectClass::kPerson);
  EXPECT_GT(map.objects()[0].box.velocity.x(), 0.9);
  EXPECT_EQ(map.objects()[1].box.object_class, ObjectClass::kAgv);
  EXPECT_LT(map.objects()[1].box.velocity.x(), -0.9);
  EXPECT_EQ(map.confirmed(), 2);
}

TEST(DynamicMap, CoastsThroughOcclusionThenEnds) {
  DynamicMap map;
  const auto cluster = [](int i) { return cluster_at({static_cast<float>(0.08 * i), 0.0F, 3.0F}); };
  for (int i = 0; i < 15; ++i) update(map, i, {cluster(i)});
  for (int i = 15; i < 20; ++i) update(map, i, {});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].state, TrackState::kCoasting);
  EXPECT_NEAR(map.objects()[0].box.center().x(), 0.08 * 19, 0.15);
  for (int i = 20; i < 32; ++i) update(map, i, {});
  EXPECT_TRUE(map.objects().empty());  // unseen for longer than coasting objects are output
  update(map, 32, {cluster(32)});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].box.id, 1);
  EXPECT_EQ(map.objects()[0].state, TrackState::kActive);
  for (int i = 33; i < 100; ++i) update(map, i, {});
  for (int i = 100; i < 105; ++i) update(map, i, {cluster(i)});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].box.id, 2);
}

/// A moving cluster without a mask.
DynamicCluster moving_at(const Eigen::Vector3f& center) {
  DynamicCluster cluster = cluster_at(center, ObjectClass::kUnknown);
  cluster.score = 0.0F;
  return cluster;
}

TEST(DynamicMap, ClusterWithoutMaskHasUnknownClass) {
  DynamicMap map;
  const auto cluster = [](int i) { return moving_at({static_cast<float>(0.07 * i), 0.0F, 3.0F}); };
  for (int i = 0; i < 9; ++i) update(map, i, {cluster(i)});
  EXPECT_TRUE(map.objects().empty());  // it may be an error of the pose
  for (int i = 9; i < 20; ++i) update(map, i, {cluster(i)});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].box.object_class, ObjectClass::kUnknown);
  EXPECT_TRUE(map.objects()[0].box.moving);
  EXPECT_NEAR(map.objects()[0].box.velocity.x(), 1.05, 0.2);
}

TEST(DynamicMap, UnknownObjectTakesClassOfLaterMask) {
  DynamicMap map;
  const auto position = [](int i) { return Eigen::Vector3f(static_cast<float>(0.07 * i), 0, 3); };
  for (int i = 0; i < 20; ++i) update(map, i, {moving_at(position(i))});
  for (int i = 20; i < 24; ++i) update(map, i, {cluster_at(position(i))});
  for (int i = 24; i < 40; ++i) update(map, i, {moving_at(position(i))});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].box.object_class, ObjectClass::kPerson);
  EXPECT_EQ(map.objects()[0].box.id, 1);
  EXPECT_EQ(map.objects()[0].state, TrackState::kActive);
}

TEST(DynamicMap, MergesMovingPartIntoAdjacentObject) {
  DynamicMap map;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3f position(static_cast<float>(0.07 * i), 0, 3);
    DynamicCluster arm = moving_at(position + Eigen::Vector3f(0.4F, 0.0F, 0.0F));
    arm.box_min = arm.centroid.array() - 0.1F;
    arm.box_max = arm.centroid.array() + 0.1F;
    update(map, i, {cluster_at(position), arm});
  }
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.confirmed(), 1);
}

TEST(DynamicMap, KeepsIdOfStoppedObject) {
  DynamicMap map;
  for (int i = 0; i < 30; ++i) {
    update(map, i, {cluster_at({static_cast<float>(0.07 * i), 0.0F, 3.0F})});
  }
  EXPECT_TRUE(map.objects().at(0).box.moving);
  int stop_frame = -1;
  for (int i = 30; i < 330; ++i) {
    update(map, i, {cluster_at({static_cast<float>(0.07 * 29), 0.0F, 3.0F})});
    if (stop_frame < 0 && !map.objects().at(0).box.moving) stop_frame = i;
  }
  EXPECT_LT(kPeriod * (stop_frame - 30), 1.0);
  EXPECT_EQ(map.objects().at(0).box.id, 1);
  EXPECT_FALSE(map.objects()[0].box.moving);
  EXPECT_EQ(map.confirmed(), 1);
}

TEST(DynamicMap, DropsSingleObservation) {
  DynamicMap map;
  update(map, 0, {cluster_at({0.0F, 0.0F, 2.0F})});
  for (int i = 1; i < 80; ++i) update(map, i, {});
  EXPECT_TRUE(map.objects().empty());
  EXPECT_EQ(map.confirmed(), 0);
}

TEST(DynamicMap, DoesNotAssociateBeyondGate) {
  DynamicMap map;
  for (int i = 0; i < 5; ++i) update(map, i, {cluster_at({0.0F, 0.0F, 2.0F})});
  for (int i = 5; i < 10; ++i) update(map, i, {cluster_at({2.0F, 0.0F, 2.0F})});
  EXPECT_EQ(map.confirmed(), 2);
}

TEST(DynamicMap, ClassIsMajorityOfFrames) {
  DynamicMap map;
  for (int i = 0; i < 9; ++i) {
    const auto seen = i % 3 == 0 ? ObjectClass::kPerson : ObjectClass::kAgv;
    update(map, i, {cluster_at({0.0F, 0.0F, 2.0F}, seen)});
  }
  EXPECT_EQ(map.objects().at(0).box.object_class, ObjectClass::kAgv);
}

TEST(DynamicMap, FragmentStartsNoObject) {
  DynamicMap map;
  const DynamicCluster whole = cluster_at({0.0F, 0.0F, 2.0F});
  DynamicCluster foot = cluster_at({0.0F, 0.7F, 2.0F});
  foot.box_min = foot.centroid - Eigen::Vector3f::Constant(0.05F);
  foot.box_max = foot.centroid + Eigen::Vector3f::Constant(0.05F);
  for (int i = 0; i < 10; ++i) update(map, i, {whole});
  for (int i = 10; i < 20; ++i) update(map, i, {whole, foot});
  EXPECT_EQ(map.objects().size(), 1U);
}

TEST(DynamicMap, KeepsIdsAfterMergeAndSplit) {
  DynamicMap map;
  // Two walk side by side, form one cluster for half a second, and separate again.
  for (int i = 0; i < 40; ++i) {
    const auto x = static_cast<float>(0.06 * i);
    const DynamicCluster near = cluster_at({x, 0.0F, 2.5F});
    const DynamicCluster far = cluster_at({x, 0.0F, 3.1F});
    DynamicCluster both = cluster_at({x, 0.0F, 2.8F});
    both.box_min.z() = near.box_min.z();
    both.box_max.z() = far.box_max.z();
    i >= 20 && i < 27 ? update(map, i, {both}) : update(map, i, {near, far});
  }
  ASSERT_EQ(map.objects().size(), 2U);
  EXPECT_EQ(map.confirmed(), 2);
  EXPECT_LT(map.objects()[0].box.size.maxCoeff(), 1.8);
}

TEST(DynamicMap, LowScoreStartsNoObject) {
  DynamicMap map;
  DynamicCluster cluster = cluster_at({0.0F, 0.0F, 2.0F});
  cluster.score = 0.2F;
  for (int i = 0; i < 10; ++i) update(map, i, {cluster});
  EXPECT_TRUE(map.objects().empty());
  cluster.score = 0.9F;
  for (int i = 10; i < 15; ++i) update(map, i, {cluster});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_NEAR(map.objects()[0].box.score, (10 * 0.2 + 5 * 0.9) / 15, 1e-6);
}

TEST(DynamicMap, RememberedMaskKeepsButStartsNoObject) {
  DynamicMap map;
  DynamicCluster remembered = cluster_at({0.0F, 0.0F, 2.0F});
  remembered.score = 0.0F;
  for (int i = 0; i < 10; ++i) update(map, i, {remembered});
  EXPECT_TRUE(map.objects().empty());
  for (int i = 10; i < 16; ++i) update(map, i, {cluster_at({0.0F, 0.0F, 2.0F})});
  for (int i = 16; i < 20; ++i) update(map, i, {remembered});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].state, TrackState::kActive);
  EXPECT_EQ(map.objects()[0].box.score, 1.0);
}

TEST(DynamicMap, OverruledMaskKeepsButStartsNoObject) {
  DynamicMap map;
  const std::vector<DynamicCluster> person = {cluster_at({0.0F, 0.0F, 2.0F})};
  const Eigen::Isometry3d at_origin = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 10; ++i) update(map, i, person, at_origin, true);
  EXPECT_TRUE(map.objects().empty());
  for (int i = 10; i < 16; ++i) update(map, i, person);
  for (int i = 16; i < 20; ++i) update(map, i, person, at_origin, true);
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].state, TrackState::kActive);
}

TEST(DynamicMap, SecondClusterOfMaskStartsNoObject) {
  DynamicMap map;
  DynamicCluster person = cluster_at({0.0F, 0.0F, 2.0F});
  DynamicCluster wall = cluster_at({0.5F, 0.0F, 4.0F});
  person.instance = wall.instance = 3;
  for (int i = 0; i < 10; ++i) update(map, i, {person, wall});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_LT(map.objects()[0].box.center().z(), 2.5);
}

TEST(DynamicMap, PrefersTrackedClusterOverLargerOne) {
  DynamicMap map;
  DynamicCluster vehicle = cluster_at({0.0F, 0.0F, 3.0F}, ObjectClass::kAgv);
  DynamicCluster shelf = cluster_at({0.5F, 0.0F, 5.0F}, ObjectClass::kAgv);
  vehicle.instance = shelf.instance = 3;
  for (int i = 0; i < 10; ++i) update(map, i, {vehicle});
  for (int i = 10; i < 30; ++i) update(map, i, {shelf, vehicle});  // the largest comes first
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_EQ(map.objects()[0].state, TrackState::kActive);
  EXPECT_LT(map.objects()[0].box.center().z(), 3.5);
  EXPECT_EQ(map.confirmed(), 1);
}

TEST(DynamicMap, OneMaskOverTwoKnownPeopleKeepsBoth) {
  DynamicMap map;
  DynamicCluster near = cluster_at({0.0F, 0.0F, 2.5F});
  DynamicCluster far = cluster_at({0.3F, 0.0F, 3.9F});
  near.instance = 0;
  far.instance = 1;
  for (int i = 0; i < 15; ++i) update(map, i, {near, far});
  far.instance = 0;
  for (int i = 15; i < 45; ++i) update(map, i, {near, far});
  ASSERT_EQ(map.objects().size(), 2U);
  for (const TrackedObject& object : map.objects()) EXPECT_EQ(object.state, TrackState::kActive);
}

/// Where the first leaves and another comes, everybody could continue the track of the one before.
TEST(DynamicMap, KeepsIdsInALineOfPeople) {
  constexpr double kGap = 0.7;    // [m]
  constexpr double kSpeed = 1.2;  // [m/s]
  DynamicMap map;
  std::map<int, std::set<int>> ids_of;  // by number of the person
  for (int i = 0; i < 105; ++i) {
    std::map<int, double> seen;
    std::vector<DynamicCluster> clusters;
    for (int person = 0; person < 12; ++person) {
      const double x = -1.5 + kSpeed * kPeriod * i - kGap * person;
      if (std::abs(x) > 1.5) continue;
      seen[person] = x;
      clusters.push_back(cluster_at({static_cast<float>(x), 0.0F, 4.0F}));
      clusters.back().instance = person;
    }
    update(map, i, clusters);
    for (const TrackedObject& object : map.objects()) {
      if (object.state != TrackState::kActive) continue;
      for (const auto& [person, x] : seen) {
        if (std::abs(object.box.center().x() - x) < 0.3) ids_of[person].insert(object.box.id);
      }
    }
  }
  EXPECT_GE(ids_of.size(), 8U);
  for (const auto& [person, ids] : ids_of) EXPECT_EQ(ids.size(), 1U) << person;
}

TEST(DynamicMap, OneMaskKeepsOneObject) {
  DynamicMap map;
  DynamicCluster engine = cluster_at({0.0F, 0.0F, 3.0F}, ObjectClass::kAgv);
  DynamicCluster mast = cluster_at({0.0F, 0.0F, 4.2F}, ObjectClass::kAgv);
  engine.instance = 0;
  mast.instance = 1;
  for (int i = 0; i < 10; ++i) update(map, i, {engine, mast});
  EXPECT_EQ(map.objects().size(), 2U);
  mast.instance = 0;
  for (int i = 10; i < 40; ++i) update(map, i, {engine, mast});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_LT(map.objects()[0].box.center().z(), 3.5);
}

TEST(DynamicMap, IgnoresClustersWithoutPoints) {
  DynamicMap map;
  DynamicCluster empty = cluster_at({0.0F, 0.0F, 1.0F});
  empty.box_min.setConstant(NAN);
  for (int i = 0; i < 10; ++i) update(map, i, {empty, cluster_at({0.0F, 0.0F, 3.0F})});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_NEAR(map.objects()[0].box.center().z(), 3.0, 0.3);
}

TEST(DynamicMap, IgnoresFramesOutOfOrder) {
  DynamicMap map;
  for (const int index : {3, 3, 1, 3}) update(map, index, {cluster_at({0.0F, 0.0F, 2.0F})});
  EXPECT_EQ(map.confirmed(), 0);
}

TEST(DynamicMap, FindsTheFloorUpToTheTiltOfTheSettings) {
  test::Room room;
  room.boxes.push_back({{-0.9, -0.25, 0.0}, {-0.5, 0.25, 1.7}, PointLabel::kDynamic});
  const auto camera = test::camera_in_room({-2.0, 0.0, 1.4}, 0.0, 0.9);  // 52 degrees down
  LabeledCloud cloud = test::view(room, camera);
  cloud.cluster.assign(cloud.points.size(), -1);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] == PointLabel::kDynamic) cloud.cluster[i] = 0;
  }
  cloud.clusters.emplace_back();
  DynamicMap map({}, FloorConfig{.max_tilt = 60.0});
  for (int i = 0; i < 6; ++i) {
    cloud.stamp = Timestamp::from_seconds(1.0 + kPeriod * i);
    OdometryEstimate odometry;
    odometry.stamp = cloud.stamp;
    map.update(cloud, odometry);
  }
  ASSERT_EQ(map.objects().size(), 1U);
  const Eigen::Vector3d up = camera.rotation().transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_GT(map.objects()[0].box.T_world_box.linear().col(2).dot(up), 0.99);
}

TEST(DynamicMap, AnEmptyFirstFrameDoesNotTellUp) {
  DynamicMap map;
  map.update(LabeledCloud{}, OdometryEstimate{});
  for (int i = 0; i < 6; ++i) update(map, i, {cluster_at({0.0F, 0.0F, 2.0F})});
  ASSERT_EQ(map.objects().size(), 1U);
  EXPECT_NEAR(map.objects()[0].box.T_world_box.linear().col(2).y(), -1.0, 1e-9);
}

}  // namespace
}  // namespace mms
