#include "mms/mapping/ground/floor_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mms/mapping/ground/floor.hpp"
#include "mms/mapping/static_map/static_map.hpp"
#include "tests/mapping/synthetic_room.hpp"

namespace mms {
namespace {

using namespace test;  // NOLINT: helpers of the tests

OccupancyVoxels make_voxels(std::vector<VoxelKey> occupied, std::vector<VoxelKey> free) {
  return {0.1, std::move(occupied), std::move(free)};
}

Occupancy first_cell(const OccupancyVoxels& voxels) {
  const OccupancyGrid grid = floor_grid(voxels, Transform<World, Map>(), GridConfig{});
  return grid.cells.empty() ? Occupancy::kUnknown : grid.cells[0];
}

TEST(FloorGrid, ClassifiesColumnByItsVoxels) {
  EXPECT_EQ(first_cell(make_voxels({}, {})), Occupancy::kUnknown);
  EXPECT_EQ(first_cell(make_voxels({{0, 0, 0}}, {})), Occupancy::kFree) << "floor";
  EXPECT_EQ(first_cell(make_voxels({}, {{0, 0, 3}})), Occupancy::kFree) << "low and empty";
  EXPECT_EQ(first_cell(make_voxels({}, {{0, 0, 9}})), Occupancy::kUnknown) << "high and empty";
  EXPECT_EQ(first_cell(make_voxels({{0, 0, 5}, {0, 0, 6}}, {{0, 0, 3}})), Occupancy::kOccupied)
      << "table";
  EXPECT_EQ(first_cell(make_voxels({{0, 0, 16}, {0, 0, 17}}, {})), Occupancy::kOccupied) << "head";
  EXPECT_EQ(first_cell(make_voxels({{0, 0, 19}}, {{0, 0, 1}})), Occupancy::kFree) << "lamp";
  EXPECT_EQ(first_cell(make_voxels({{0, 0, 7}}, {{0, 0, 3}})), Occupancy::kFree) << "single voxel";
  EXPECT_EQ(first_cell(make_voxels({{0, 0, 0}, {0, 0, 1}}, {})), Occupancy::kFree)
      << "on the floor";
  EXPECT_EQ(first_cell(make_voxels({{0, 0, -9}}, {})), Occupancy::kUnknown) << "pit";
}

TEST(FloorGrid, OriginIsLowestCorner) {
  const OccupancyGrid grid = floor_grid(make_voxels({{-3, 5, 4}, {-3, 5, 5}}, {{1, -2, 3}}),
                                        Transform<World, Map>(), GridConfig{});
  EXPECT_EQ(grid.cells.width(), 5);
  EXPECT_EQ(grid.cells.height(), 8);
  EXPECT_TRUE(grid.origin.isApprox(Eigen::Vector2d(-0.3, -0.2)));
  EXPECT_EQ(grid.cells(0, 7), Occupancy::kOccupied);
  EXPECT_EQ(grid.cells(4, 0), Occupancy::kFree);
  EXPECT_EQ(grid.cells(2, 3), Occupancy::kUnknown);
}

TEST(FloorGrid, LargeMapsGetCoarseCells) {
  const OccupancyGrid grid =
      floor_grid(make_voxels({{-60000, -60000, 4}, {-60000, -60000, 5}}, {{60000, 60000, 4}}),
                 Transform<World, Map>(), GridConfig{});
  EXPECT_LE(grid.cells.size(), 100'000'000U);
  EXPECT_NEAR(grid.resolution, 1.6, 1e-9);
  EXPECT_EQ(grid.cells(0, 0), Occupancy::kOccupied);
}

TEST(AddOccupied, MarksTheVoxelsOfPoints) {
  OccupancyVoxels voxels{0.1, {{0, 0, 5}}, {{1, 2, 3}, {4, 4, 4}}};
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();
  T_world_map.translation() = Eigen::Vector3d(1.0, 0.0, 0.0);
  add_occupied({{1.15F, 0.25F, 0.35F},
                {1.16F, 0.25F, 0.35F},
                {0.95F, 0.05F, 0.05F},
                {NAN, 0, 0},
                {0, 0, NAN},
                {1e30F, 0, 0}},
               Transform<World, Map>(T_world_map), voxels);
  EXPECT_EQ(voxels.occupied, (std::vector<VoxelKey>{{-1, 0, 0}, {0, 0, 5}, {1, 2, 3}}));
  EXPECT_EQ(voxels.free, (std::vector<VoxelKey>{{4, 4, 4}}));
}

TEST(RemoveOccupied, PointsThatAreGoneAreFree) {
  OccupancyVoxels voxels{0.1, {{1, 2, 3}, {4, 5, 6}}, {{0, 0, 0}}};
  remove_occupied({{0.15F, 0.25F, 0.35F}, {0.75F, 0.05F, 0.05F}}, Transform<World, Map>(), voxels);
  EXPECT_EQ(voxels.occupied, (std::vector<VoxelKey>{{4, 5, 6}}));
  EXPECT_EQ(voxels.free, (std::vector<VoxelKey>{{0, 0, 0}, {1, 2, 3}}));
}

/// A camera pitched down by 25 degrees maps a room with a crate, a door sill and a lamp.
class TiltedCamera : public ::testing::Test {
 protected:
  TiltedCamera() {
    room_.boxes = {{{0.8, -0.3, 0.0}, {1.4, 0.3, 0.6}},
                   {{-1.2, 0.5, 0.0}, {-0.6, 1.0, 0.04}},
                   {{0.0, 0.8, 2.0}, {0.3, 1.1, 2.3}}};
    for (const double x : {-2.0, 0.0, 2.2}) {
      for (const double y : {-1.2, 1.3}) {
        for (int i = 0; i < 12; ++i) integrate(camera_in_room({x, y, 1.2}, i * 0.5236, 0.436));
      }
    }
    floor_ = find_floor(static_map_.cloud(), SensorAxes::camera().up, FloorConfig{});
    T_world_map_ = map_frame(floor_, SensorAxes::camera().forward);
    voxels_ = voxels_in_map_frame(occupancy_, T_world_map_);
    grid_ = floor_grid(voxels_, T_world_map_, GridConfig{});
  }

  void integrate(const Transform<RoomFrame, Sensor>& T_room_sensor) {
    const Transform<World, Sensor> T_world_sensor(T_room_first_.isometry().inverse() *
                                                  T_room_sensor.isometry());
    const LabeledCloud cloud = view(room_, T_room_sensor);
    static_map_.integrate(cloud, T_world_sensor);
    occupancy_.integrate(cloud, T_world_sensor);
  }

  /// Cells whose center lies in the rectangle of the room, by state.
  std::map<Occupancy, int> count(double x0, double y0, double x1, double y1) const {
    std::map<Occupancy, int> counts;
    for (int v = 0; v < grid_.cells.height(); ++v) {
      for (int u = 0; u < grid_.cells.width(); ++u) {
        const Eigen::Vector2d center =
            grid_.origin + grid_.resolution * Eigen::Vector2d(u + 0.5, v + 0.5);
        const Eigen::Vector3d p =
            T_room_first_.isometry() * (T_world_map_ * Eigen::Vector3d(center.x(), center.y(), 0));
        if (p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1) ++counts[grid_.cells(u, v)];
      }
    }
    return counts;
  }

  Room room_;
  Transform<RoomFrame, Sensor> T_room_first_ = camera_in_room({-2.0, -1.2, 1.2}, 0.0, 0.436);
  StaticMap static_map_;
  OccupancyMap occupancy_;
  Floor floor_;
  Transform<World, Map> T_world_map_;
  OccupancyVoxels voxels_;
  OccupancyGrid grid_;
};

TEST_F(TiltedCamera, FindsFloor) {
  ASSERT_TRUE(floor_.found);
  const Eigen::Vector3d up = T_room_first_.rotation() * floor_.up;
  EXPECT_GT(up.z(), std::cos(0.005));
  EXPECT_NEAR(floor_.height, -1.2, 0.01);
}

TEST_F(TiltedCamera, FloorIsFreeAndCrateOccupied) {
  auto crate = count(0.9, -0.2, 1.3, 0.2);
  EXPECT_GE(crate[Occupancy::kOccupied], 4);  // its top is visible
  EXPECT_EQ(crate[Occupancy::kFree], 0);
  auto open = count(-2.7, -1.7, 0.6, 1.7);
  EXPECT_EQ(open[Occupancy::kOccupied], 0);  // sill and lamp are not obstacles
  EXPECT_LT(open[Occupancy::kUnknown], open[Occupancy::kFree] / 50);
}

TEST_F(TiltedCamera, WallsAreOccupied) {
  for (int i = 0; i < 30; ++i) {
    const double y = -1.5 + 0.1 * i;
    EXPECT_GE(count(2.8, y - 0.06, 3.2, y + 0.06)[Occupancy::kOccupied], 1) << y;
  }
  EXPECT_EQ(count(3.25, -2.0, 10.0, 2.0)[Occupancy::kFree], 0);
  EXPECT_EQ(count(3.25, -2.0, 10.0, 2.0)[Occupancy::kOccupied], 0);
}

TEST_F(TiltedCamera, VoxelsAreUniqueAndSorted) {
  EXPECT_TRUE(std::is_sorted(voxels_.occupied.begin(), voxels_.occupied.end()));
  std::set<VoxelKey> all(voxels_.occupied.begin(), voxels_.occupied.end());
  all.insert(voxels_.free.begin(), voxels_.free.end());
  EXPECT_EQ(all.size(), voxels_.occupied.size() + voxels_.free.size());
}

TEST(FloorGrid, FloorIsFreeForVoxelsOfAnySize) {
  for (const double size : {0.1, 0.2, 0.3, 0.4, 0.8, 1.2}) {
    for (const int z : {-1, 0}) {
      const OccupancyVoxels floor{size, {{0, 0, z}, {0, 1, z}, {1, 0, z}, {1, 1, z}}, {}};
      EXPECT_EQ(first_cell(floor), Occupancy::kFree) << size << " m, layer " << z;
    }
    EXPECT_EQ(first_cell({size, {}, {{0, 0, 0}}}), Occupancy::kFree) << size << " m, empty";
  }
  EXPECT_EQ(first_cell({0.4, {{0, 0, 1}, {0, 0, 2}}, {}}), Occupancy::kOccupied) << "a wall";
}

}  // namespace
}  // namespace mms
