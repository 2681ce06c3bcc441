#include "mms/io/results/occupancy_grid_io.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

OccupancyGrid small_grid() {
  OccupancyGrid grid;
  grid.resolution = 0.05;
  grid.origin = {-1.5, 0.25};
  grid.cells = Image<Occupancy>(3, 2, Occupancy::kUnknown);
  grid.cells(0, 0) = Occupancy::kOccupied;
  grid.cells(2, 1) = Occupancy::kFree;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(0.5, 1.25, -2.0);
  grid.T_world_map = Transform<World, Map>(T);
  return grid;
}

TEST(OccupancyGridIo, ImageHasLargestYOnTop) {
  const TempFolder folder;
  write_occupancy_grid(folder.path() / "map.yaml", small_grid());
  const std::string expected = "P5\n3 2\n255\n\xCD\xCD\xFE" + std::string("\0\xCD\xCD", 3);
  EXPECT_EQ(read_file(folder.path() / "map.pgm"), expected);
}

TEST(OccupancyGridIo, YamlHasMapServerKeys) {
  const TempFolder folder;
  write_occupancy_grid(folder.path() / "room.yaml", small_grid());
  const YAML::Node yaml = YAML::LoadFile((folder.path() / "room.yaml").string());
  EXPECT_EQ(yaml["image"].as<std::string>(), "room.pgm");
  EXPECT_EQ(yaml["mode"].as<std::string>(), "trinary");
  EXPECT_EQ(yaml["resolution"].as<double>(), 0.05);
  EXPECT_EQ(yaml["origin"].as<std::vector<double>>(), (std::vector<double>{-1.5, 0.25, 0.0}));
  EXPECT_EQ(yaml["negate"].as<int>(), 0);
  EXPECT_EQ(yaml["occupied_thresh"].as<double>(), 0.65);
  // Map servers take cells below the threshold as free.
  EXPECT_GT((255.0 - 205.0) / 255.0, yaml["free_thresh"].as<double>());
}

TEST(OccupancyGridIo, MapFrameRoundTrips) {
  const TempFolder folder;
  const OccupancyGrid grid = small_grid();
  write_occupancy_grid(folder.path() / "map.yaml", grid);
  const YAML::Node frame = YAML::LoadFile((folder.path() / "map.yaml").string())["T_world_map"];
  const auto t = frame["translation"].as<std::vector<double>>();
  const auto q = frame["quaternion"].as<std::vector<double>>();
  ASSERT_EQ(q.size(), 4U);
  const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  EXPECT_TRUE(rotation.toRotationMatrix().isApprox(grid.T_world_map.rotation(), 1e-12));
  EXPECT_EQ(Eigen::Vector3d(t[0], t[1], t[2]), grid.T_world_map.translation());
}

TEST(OccupancyGridIo, EmptyGridIsOneUnknownCell) {
  const TempFolder folder;
  write_occupancy_grid(folder.path() / "map.yaml", OccupancyGrid{});
  EXPECT_EQ(read_file(folder.path() / "map.pgm"), "P5\n1 1\n255\n\xCD");
}

TEST(OccupancyGridIo, ErrorNamesMissingFolder) {
  const TempFolder folder;
  expect_in("map.pgm: cannot be written", message_of<FileError>([&] {
              write_occupancy_grid(folder.path() / "none/map.yaml", small_grid());
            }));
}

}  // namespace
}  // namespace mms
