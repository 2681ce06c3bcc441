#include "mms/mapping/ground/floor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mms/core/random_stream.hpp"

namespace mms {
namespace {

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

/// Points on a rectangle, a few centimetres apart, with noise along its normal.
void add_plane(const Eigen::Vector3d& corner, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
               MapCloud& map, double noise = 0.01) {
  RandomStream random(map.size() + 1);
  const Eigen::Vector3d normal = a.cross(b).normalized();
  const auto count = static_cast<int>(a.cross(b).norm() / (0.04 * 0.04));
  for (int i = 0; i < count; ++i) {
    const double error = noise * (random.uniform() + random.uniform() - 1.0);
    const Eigen::Vector3d point =
        corner + random.uniform() * a + random.uniform() * b + error * normal;
    map.points.push_back(point.cast<float>());
    map.normals.push_back(normal.cast<float>());
  }
}

/// A room of 6 m x 5 m: floor at z = 0, a table, two walls, a ceiling.
MapCloud room() {
  MapCloud map;
  add_plane({-3, -2, 0}, {6, 0, 0}, {0, 5, 0}, map);
  add_plane({1, 0, 0.75}, {1.6, 0, 0}, {0, 0.8, 0}, map);
  add_plane({-3, -2, 0}, {0, 5, 0}, {0, 0, 2.5}, map);
  add_plane({-3, 3, 0}, {6, 0, 0}, {0, 0, 2.5}, map);
  add_plane({-3, -2, 2.5}, {0, 5, 0}, {6, 0, 0}, map);
  return map;
}

MapCloud moved(MapCloud map, const Eigen::Isometry3d& T) {
  for (Eigen::Vector3f& point : map.points) point = T.cast<float>() * point;
  for (Eigen::Vector3f& normal : map.normals) normal = T.linear().cast<float>() * normal;
  return map;
}

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::min(1.0, a.dot(b)));
}

TEST(Floor, IsFoundWithTiltedSensor) {
  for (const double pitch : {-35.0, -20.0, 0.0, 10.0, 35.0}) {
    for (const double roll : {-10.0, 0.0, 15.0}) {
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      T.linear() = (Eigen::AngleAxisd(radians(pitch), Eigen::Vector3d::UnitY()) *
                    Eigen::AngleAxisd(radians(roll), Eigen::Vector3d::UnitX()))
                       .toRotationMatrix();
      T.translation() = T.linear() * Eigen::Vector3d(0.3, -0.2, -1.1);
      const Floor floor = find_floor(moved(room(), T), kUp, FloorConfig{});
      ASSERT_TRUE(floor.found) << pitch << ' ' << roll;
      EXPECT_LT(angle(floor.up, T.linear() * kUp), radians(0.3)) << pitch << ' ' << roll;
      EXPECT_NEAR(floor.height, -1.1, 0.015) << pitch << ' ' << roll;
    }
  }
}

TEST(Floor, NeedsNoNormals) {
  MapCloud map = room();
  for (Eigen::Vector3f& normal : map.normals) normal.setZero();
  const Floor floor = find_floor(map, kUp, FloorConfig{});
  ASSERT_TRUE(floor.found);
  EXPECT_NEAR(floor.height, 0.0, 0.01);
}

TEST(Floor, IsLowestLevelNotLargest) {
  MapCloud map;
  add_plane({0, 0, 0}, {2, 0, 0}, {0, 1.5, 0}, map);
  add_plane({0, 2, 0.75}, {4, 0, 0}, {0, 3, 0}, map);
  const Floor floor = find_floor(map, kUp, FloorConfig{});
  ASSERT_TRUE(floor.found);
  EXPECT_NEAR(floor.height, 0.0, 0.01);
}

TEST(Floor, IgnoresOutliersBelow) {
  MapCloud map = room();
  add_plane({0, 0, -1.0}, {0.5, 0, 0}, {0, 0.5, 0}, map);
  const Floor floor = find_floor(map, kUp, FloorConfig{});
  EXPECT_NEAR(floor.height, 0.0, 0.01);
}

TEST(Floor, IgnoresCeilingsAndWalls) {
  MapCloud map;
  add_plane({-3, -2, 2.5}, {0, 5, 0}, {6, 0, 0}, map);
  add_plane({-3, -2, 0}, {0, 5, 0}, {0, 0, 2.5}, map);
  const Floor floor = find_floor(map, kUp, FloorConfig{});
  EXPECT_FALSE(floor.found);
  EXPECT_EQ(floor.up, kUp);
  EXPECT_NEAR(floor.height, 0.1, 0.2);  // the lowest points without outliers
}

TEST(Floor, EmptyMapGivesSensorHeight) {
  const Floor floor = find_floor(MapCloud{}, kUp, FloorConfig{});
  EXPECT_FALSE(floor.found);
  EXPECT_EQ(floor.height, 0.0);
  EXPECT_TRUE(map_frame(floor, Eigen::Vector3d::UnitX())
                  .isometry()
                  .isApprox(Eigen::Isometry3d::Identity()));
}

TEST(Floor, MapFrameIsOnFloorBelowSensor) {
  const Floor floor{Eigen::Vector3d(0.1, -1.0, 0.3).normalized(), -1.4, true};
  const Transform<World, Map> T = map_frame(floor, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(T.rotation().determinant(), 1.0, 1e-12);
  EXPECT_TRUE(T.rotation().col(2).isApprox(floor.up));
  EXPECT_GT(T.rotation().col(0).z(), 0.9);
  EXPECT_TRUE((T.inverse() * Eigen::Vector3d::Zero()).isApprox(Eigen::Vector3d(0, 0, 1.4), 1e-9));
}

TEST(Floor, MapFrameExistsForDownwardSensor) {
  const Floor floor{-Eigen::Vector3d::UnitZ(), -1.4, true};
  const Transform<World, Map> T = map_frame(floor, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE((T.rotation() * T.rotation().transpose()).isIdentity(1e-12));
}

}  // namespace
}  // namespace mms
