#include "mms/mapping/occupancy/occupancy_map.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mms/core/random_stream.hpp"
#include "tests/mapping/synthetic_room.hpp"

namespace mms {
namespace {

using namespace test;  // NOLINT: helpers of the tests

constexpr double kMargin = 0.15;  // voxels that a surface crosses extend that far [m]
const Eigen::Vector3d kCenter(0.0, 0.0, 1.2);
const Eigen::Vector3d kShift(0.05, 0.05, 0.05);

/// A map of the room. Its world frame is the room's, shifted so that walls and floor go through the
/// center of voxels and do not lie on their borders.
class RoomMap {
 public:
  explicit RoomMap(const OccupancyConfig& config = {}) : map(config) {}

  void integrate(const Room& room, const Transform<RoomFrame, Sensor>& T_room_sensor) {
    map.integrate(view(room, T_room_sensor), in_world(T_room_sensor));
  }

  void integrate_all_yaws(const Room& room, const Eigen::Vector3d& position, double pitch = 0.3) {
    for (int i = 0; i < 12; ++i) integrate(room, camera_in_room(position, i * 0.5236, pitch));
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

/// A person `x` metres in front of the center of the room.
Box person(double x, PointLabel label) {
  return {{x - 0.2, -0.25, 0.0}, {x + 0.2, 0.25, 1.75}, label};
}

TEST(OccupancyMap, EmptyRoomIsFreeAndUnknownBeyondWalls) {
  const Room room;
  RoomMap room_map;
  for (const double x : {-1.5, 0.0, 1.5}) {
    room_map.integrate_all_yaws(room, {x, 0.0, 1.2}, 0.4);
    room_map.integrate_all_yaws(room, {x, 0.0, 1.2}, -0.4);
  }
  EXPECT_GT(room_map.share(inside(room), Occupancy::kFree), 0.98);
  EXPECT_EQ(room_map.share(inside(room), Occupancy::kOccupied), 0.0);
  EXPECT_EQ(room_map.share(points_in({3.15, -2, 0}, {5, 2, 2.5}), Occupancy::kUnknown), 1.0);
  EXPECT_EQ(room_map.share(points_in({-3, -2, -1}, {3, 2, -0.15}), Occupancy::kUnknown), 1.0);
  EXPECT_GT(room_map.share(points_in({3, -1.8, 0.2}, {3, 1.8, 2.3}), Occupancy::kOccupied), 0.98);
  EXPECT_GT(room_map.share(points_in({-2.8, -1.8, 0}, {2.8, 1.8, 0}), Occupancy::kOccupied), 0.95);
}

TEST(OccupancyMap, HiddenSpaceStaysUnknown) {
  for (const PointLabel label : {PointLabel::kStatic, PointLabel::kDynamic}) {
    Room room;
    room.boxes = {{{1.0, -0.5, 0.0}, {1.3, 0.5, 2.5}, label}};
    RoomMap room_map;
    for (int i = 0; i < 10; ++i) room_map.integrate(room, camera_in_room({-2.0, 0.0, 1.2}, 0.0));
    EXPECT_EQ(room_map.share(points_in({1.5, -0.5, 0.2}, {2.8, 0.5, 2.3}), Occupancy::kUnknown),
              1.0);
    EXPECT_EQ(room_map.share(points_in({-1.7, -0.2, 1.0}, {0.7, 0.2, 1.4}), Occupancy::kFree), 1.0);
  }
}

TEST(OccupancyMap, DynamicPersonLeavesNoOccupiedVoxels) {
  RoomMap room_map;
  for (int i = 0; i <= 20; ++i) {
    Room room;
    room.boxes = {person(-1.0 + 0.15 * i, PointLabel::kDynamic)};
    room_map.integrate(room, camera_in_room({-2.8, 0.0, 1.2}, 0.0, 0.2));
  }
  room_map.integrate(Room{}, camera_in_room({-2.8, 0.0, 1.2}, 0.0, 0.2));
  EXPECT_EQ(room_map.share(inside(Room{}), Occupancy::kOccupied), 0.0);
  // The path is free down to the floor.
  EXPECT_EQ(room_map.share(points_in({0.5, -0.25, 0.15}, {1.8, 0.25, 1.2}), Occupancy::kFree), 1.0);
}

TEST(OccupancyMap, ClearsMislabeledPersonOnceSeenThrough) {
  Room room;
  room.boxes = {person(0.5, PointLabel::kStatic)};
  RoomMap room_map;
  const auto camera = camera_in_room({-2.0, 0.0, 1.2}, 0.0, 0.2);
  for (int i = 0; i < 50; ++i) room_map.integrate(room, camera);
  const auto ghost = points_in({0.3, -0.2, 0.3}, {0.3, 0.2, 1.6});
  EXPECT_GT(room_map.share(ghost, Occupancy::kOccupied), 0.85);  // not at the boundaries
  for (int i = 0; i < 7; ++i) room_map.integrate(Room{}, camera);
  EXPECT_EQ(room_map.share(ghost, Occupancy::kFree), 1.0);
}

TEST(OccupancyMap, KeepsThinPole) {
  Room room;
  room.boxes = {{{0.48, -0.02, 0.0}, {0.52, 0.02, 2.5}}};
  RoomMap room_map;
  for (int i = 0; i < 100; ++i) {
    room_map.integrate(room, camera_in_room({-1.8 + 0.01 * i, -0.8 + 0.016 * i, 1.2}, 0.0, 0.1));
  }
  int occupied = 0;
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d point(0.5, 0.0, 0.8 + 0.1 * i);
    occupied += room_map.share({point}, Occupancy::kOccupied) > 0.0;
  }
  EXPECT_EQ(occupied, 10);
}

TEST(OccupancyMap, GrazingRaysDoNotClearWall) {
  RoomMap room_map;
  const Room room;
  for (int i = 0; i < 60; ++i) {
    room_map.integrate(room, camera_in_room({-2.8 + 0.01 * i, -1.3, 1.2}, 0.0));
  }
  EXPECT_GT(room_map.share(points_in({-1, -2, 0.9}, {1, -2, 1.5}), Occupancy::kOccupied), 0.98);
}

TEST(OccupancyMap, FarPointsClearButDoNotOccupy) {
  OccupancyConfig config;
  config.max_range = 2.0;
  RoomMap room_map(config);
  for (int i = 0; i < 3; ++i) room_map.integrate(Room{}, camera_in_room({-2.5, 0.0, 1.2}, 0.0));
  EXPECT_EQ(room_map.share(points_in({-2.2, -0.2, 1.1}, {-0.9, 0.2, 1.3}), Occupancy::kFree), 1.0);
  EXPECT_EQ(room_map.share(points_in({-0.3, -1, 0.5}, {3.2, 1, 2}), Occupancy::kUnknown), 1.0);
}

TEST(OccupancyMap, MapsLidarScans) {
  Room room;
  room.boxes = {person(1.5, PointLabel::kDynamic)};
  RoomMap room_map;
  for (int i = 0; i < 3; ++i) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() = kCenter + kShift;
    room_map.map.integrate(scan(room, kCenter), Transform<World, Sensor>(T));
  }
  EXPECT_EQ(room_map.share(inside(room), Occupancy::kOccupied), 0.0);
  EXPECT_GT(room_map.share(points_in({-2.5, -1, 0.9}, {-0.5, 1, 1.5}), Occupancy::kFree), 0.95);
  EXPECT_GT(room_map.share(points_in({-3, -1.5, 0.8}, {-3, 1.5, 1.6}), Occupancy::kOccupied), 0.8);
}

TEST(OccupancyMap, InvalidPointsChangeNothing) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  const std::vector<Eigen::Vector3f> invalid = {
      {kNan, 0, 1}, {kInfinite, 0, 0}, {0, 0, -kInfinite}, {1e30F, 1e30F, 1e30F}, {0, 0, 0}};
  for (const PointLabel label : {PointLabel::kStatic, PointLabel::kDynamic, PointLabel::kInvalid}) {
    for (const bool organised : {false, true}) {
      LabeledCloud cloud = organised_cloud([](int, int, const Eigen::Vector3f&) { return 0.0F; });
      for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        cloud.points[i] = invalid[i % invalid.size()];
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

TEST(OccupancyMap, InvalidPosesChangeNothing) {
  OccupancyMap map;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), 1e12, -1e300}) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation().y() = bad;
    map.integrate(view(Room{}, camera_in_room(kCenter, 0.0)), Transform<World, Sensor>(T));
  }
  EXPECT_TRUE(map.blocks().all().empty());
}

TEST(OccupancyMap, MemoryIsBounded) {
  OccupancyConfig config;
  config.voxel_size = 0.02;
  config.memory = 1.0;
  RoomMap room_map(config);
  for (int i = 0; i < 5; ++i) room_map.integrate_all_yaws(Room{}, kCenter);
  EXPECT_LE(room_map.map.blocks().memory_bytes(), 1'000'000U);
  EXPECT_GT(room_map.map.voxel_size(), 0.02);
  EXPECT_GT(room_map.share(points_in({-2, -1, 1.1}, {2, 1, 1.3}), Occupancy::kFree), 0.95);
  EXPECT_EQ(room_map.share(points_in({-2, -1, 0.5}, {2, 1, 2}), Occupancy::kOccupied), 0.0);
}

TEST(OccupancyMap, DisabledMapStaysEmpty) {
  OccupancyConfig config;
  config.enabled = false;
  RoomMap room_map(config);
  room_map.integrate_all_yaws(Room{}, kCenter);
  EXPECT_TRUE(room_map.map.blocks().all().empty());
}

}  // namespace
}  // namespace mms
