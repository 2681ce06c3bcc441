#include "mms/mapping/occupancy/occupancy_map.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mms/core/random_stream.hpp"
#include "tests/mapping/synthetic_room.hpp"

namespace mms {
namespace {

using namespace test;  // NOLINT: helpers of the tests

constexpr double kMargin = 0.15;  // an edge of a voxel that a surface goes through [m]
const Eigen::Vector3d kCenter(0.0, 0.0, 1.2);
const Eigen::Vector3d kShift(0.05, 0.05, 0.05);

/// A map of the room. Its world frame is the room's, shifted so that walls and floor go through the
/// center of voxels and do not lie on their borders.
class RoomMap {
 public:
  explicit RoomMap(const OccupancyConfig& config = {}) : map(config) {}

  void look(const Room& room, const Transform<RoomFrame, Sensor>& T_room_sensor) {
    map.integrate(view(room, T_room_sensor), in_world(T_room_sensor));
  }

  void look_around(const Room& room, const Eigen::Vector3d& position, double pitch = 0.3) {
    for (int i = 0; i < 12; ++i) look(room, camera_in_room(position, i * 0.5236, pitch));
  }

  double share(const std::vector<Eigen::Vector3d>& points, Occupancy state) const {
    const auto same = std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3d& p) {
      return map.at(Eigen::Vector3d(p + kShift)) == state;
    });
    return static_cast<double>(same) / static_cast<double>(points.size());
  }

  static Transform<World, Sensor> in_world(const Transform<RoomFrame, Sensor>& T_room_sensor) {
    Eigen::Isometry3d T = T_room_sensor.isometry();
    T.pretranslate(kShift);
    return Transform<World, Sensor>(T);
  }

  OccupancyMap map;
};

std::vector<Eigen::Vector3d> points_in(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  RandomStream random(7);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Array3d share(random.uniform(), random.uniform(), random.uniform());
    points.emplace_back(low + (share * (high - low).array()).matrix());
  }
  return points;
}

std::vector<Eigen::Vector3d> inside(const Room& room) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kMargin);
  return points_in(room.low + margin, room.high - margin);
}

/// Somebody who stands `x` metres before the center of the room.
Box person(double x, PointLabel label) {
  return {{x - 0.2, -0.25, 0.0}, {x + 0.2, 0.25, 1.75}, label};
}

TEST(OccupancyMap, AnEmptyRoomIsFreeWithinItsWallsAndUnknownBeyond) {
  const Room room;
  RoomMap seen;
  for (const double x : {-1.5, 0.0, 1.5}) {
    seen.look_around(room, {x, 0.0, 1.2}, 0.4);
    seen.look_around(room, {x, 0.0, 1.2}, -0.4);
  }
  EXPECT_GT(seen.share(inside(room), Occupancy::kFree), 0.98);
  EXPECT_EQ(seen.share(inside(room), Occupancy::kOccupied), 0.0);
  EXPECT_EQ(seen.share(points_in({3.15, -2, 0}, {5, 2, 2.5}), Occupancy::kUnknown), 1.0);
  EXPECT_EQ(seen.share(points_in({-3, -2, -1}, {3, 2, -0.15}), Occupancy::kUnknown), 1.0);
  EXPECT_GT(seen.share(points_in({3, -1.8, 0.2}, {3, 1.8, 2.3}), Occupancy::kOccupied), 0.98);
  EXPECT_GT(seen.share(points_in({-2.8, -1.8, 0}, {2.8, 1.8, 0}), Occupancy::kOccupied), 0.95);
}

TEST(OccupancyMap, WhatIsHiddenStaysUnknown) {
  for (const PointLabel label : {PointLabel::kStatic, PointLabel::kDynamic}) {
    Room room;
    room.things = {{{1.0, -0.5, 0.0}, {1.3, 0.5, 2.5}, label}};
    RoomMap seen;
    for (int i = 0; i < 10; ++i) seen.look(room, camera_in_room({-2.0, 0.0, 1.2}, 0.0));
    EXPECT_EQ(seen.share(points_in({1.5, -0.5, 0.2}, {2.8, 0.5, 2.3}), Occupancy::kUnknown), 1.0);
    EXPECT_EQ(seen.share(points_in({-1.7, -0.2, 1.0}, {0.7, 0.2, 1.4}), Occupancy::kFree), 1.0);
  }
}

TEST(OccupancyMap, WhoWalksThroughLeavesNoTrace) {
  RoomMap seen;
  for (int i = 0; i <= 20; ++i) {
    Room room;
    room.things = {person(-1.0 + 0.15 * i, PointLabel::kDynamic)};
    seen.look(room, camera_in_room({-2.8, 0.0, 1.2}, 0.0, 0.2));
  }
  seen.look(Room{}, camera_in_room({-2.8, 0.0, 1.2}, 0.0, 0.2));
  EXPECT_EQ(seen.share(inside(Room{}), Occupancy::kOccupied), 0.0);
  // Where they walked is free down to the floor.
  EXPECT_EQ(seen.share(points_in({0.5, -0.25, 0.15}, {1.8, 0.25, 1.2}), Occupancy::kFree), 1.0);
}

TEST(OccupancyMap, AWalkerMistakenForAWallVanishesOnceSeenThrough) {
  Room room;
  room.things = {person(0.5, PointLabel::kStatic)};
  RoomMap seen;
  const auto camera = camera_in_room({-2.0, 0.0, 1.2}, 0.0, 0.2);
  for (int i = 0; i < 50; ++i) seen.look(room, camera);
  const auto ghost = points_in({0.3, -0.2, 0.3}, {0.3, 0.2, 1.6});
  EXPECT_GT(seen.share(ghost, Occupancy::kOccupied), 0.85);  // not at the boundaries
  for (int i = 0; i < 7; ++i) seen.look(Room{}, camera);
  EXPECT_EQ(seen.share(ghost, Occupancy::kFree), 1.0);
}

TEST(OccupancyMap, AThinPoleStays) {
  Room room;
  room.things = {{{0.48, -0.02, 0.0}, {0.52, 0.02, 2.5}}};
  RoomMap seen;
  for (int i = 0; i < 100; ++i) {
    seen.look(room, camera_in_room({-1.8 + 0.01 * i, -0.8 + 0.016 * i, 1.2}, 0.0, 0.1));
  }
  int standing = 0;
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d point(0.5, 0.0, 0.8 + 0.1 * i);
    standing += seen.share({point}, Occupancy::kOccupied) > 0.0;
  }
  EXPECT_EQ(standing, 10);
}

TEST(OccupancyMap, RaysThatGrazeAWallDoNotEatIt) {
  RoomMap seen;
  const Room room;
  for (int i = 0; i < 60; ++i) {
    seen.look(room, camera_in_room({-2.8 + 0.01 * i, -1.3, 1.2}, 0.0));
  }
  EXPECT_GT(seen.share(points_in({-1, -2, 0.9}, {1, -2, 1.5}), Occupancy::kOccupied), 0.98);
}

TEST(OccupancyMap, FarPointsFreeSpaceButAreNoObstacles) {
  OccupancyConfig config;
  config.max_range = 2.0;
  RoomMap seen(config);
  for (int i = 0; i < 3; ++i) seen.look(Room{}, camera_in_room({-2.5, 0.0, 1.2}, 0.0));
  EXPECT_EQ(seen.share(points_in({-2.2, -0.2, 1.1}, {-0.9, 0.2, 1.3}), Occupancy::kFree), 1.0);
  EXPECT_EQ(seen.share(points_in({-0.3, -1, 0.5}, {3.2, 1, 2}), Occupancy::kUnknown), 1.0);
}

TEST(OccupancyMap, MapsScansOfALidar) {
  Room room;
  room.things = {person(1.5, PointLabel::kDynamic)};
  RoomMap seen;
  for (int i = 0; i < 3; ++i) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() = kCenter + kShift;
    seen.map.integrate(scan(room, kCenter), Transform<World, Sensor>(T));
  }
  EXPECT_EQ(seen.share(inside(room), Occupancy::kOccupied), 0.0);
  EXPECT_GT(seen.share(points_in({-2.5, -1, 0.9}, {-0.5, 1, 1.5}), Occupancy::kFree), 0.95);
  EXPECT_GT(seen.share(points_in({-3, -1.5, 0.8}, {-3, 1.5, 1.6}), Occupancy::kOccupied), 0.8);
}

TEST(OccupancyMap, PointsThatAreNoneChangeNothing) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  const std::vector<Eigen::Vector3f> strange = {
      {kNan, 0, 1}, {kInfinite, 0, 0}, {0, 0, -kInfinite}, {1e30F, 1e30F, 1e30F}, {0, 0, 0}};
  for (const PointLabel label : {PointLabel::kStatic, PointLabel::kDynamic, PointLabel::kInvalid}) {
    for (const bool organised : {false, true}) {
      LabeledCloud cloud = organised_cloud([](int, int, const Eigen::Vector3f&) { return 0.0F; });
      for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        cloud.points[i] = strange[i % strange.size()];
        cloud.labels[i] = label;
      }
      if (!organised) cloud.width = static_cast<int>(cloud.points.size());
      if (!organised) cloud.height = 1;
      OccupancyMap map;
      map.integrate(cloud, Transform<World, Sensor>());
      EXPECT_TRUE(map.blocks().all().empty());
    }
  }
  OccupancyMap map;
  map.integrate(LabeledCloud{}, Transform<World, Sensor>());
  EXPECT_TRUE(map.blocks().all().empty());
}

TEST(OccupancyMap, PosesThatAreNoneChangeNothing) {
  OccupancyMap map;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), 1e12, -1e300}) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation().y() = bad;
    map.integrate(view(Room{}, camera_in_room(kCenter, 0.0)), Transform<World, Sensor>(T));
  }
  EXPECT_TRUE(map.blocks().all().empty());
}

TEST(OccupancyMap, ItsMemoryIsBounded) {
  OccupancyConfig config;
  config.voxel_size = 0.02;
  config.memory = 1.0;
  RoomMap seen(config);
  for (int i = 0; i < 5; ++i) seen.look_around(Room{}, kCenter);
  EXPECT_LE(seen.map.blocks().memory_bytes(), 1'000'000U);
  EXPECT_GT(seen.map.voxel_size(), 0.02);
  EXPECT_GT(seen.share(points_in({-2, -1, 1.1}, {2, 1, 1.3}), Occupancy::kFree), 0.95);
  EXPECT_EQ(seen.share(points_in({-2, -1, 0.5}, {2, 1, 2}), Occupancy::kOccupied), 0.0);
}

TEST(OccupancyMap, CanBeSwitchedOff) {
  OccupancyConfig config;
  config.enabled = false;
  RoomMap seen(config);
  seen.look_around(Room{}, kCenter);
  EXPECT_TRUE(seen.map.blocks().all().empty());
}

}  // namespace
}  // namespace mms
