// Merging the points of a map.
#include "mms/mapping/static_map/map_cloud.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

MapCloud three_points() {
  MapCloud map;
  map.points = {{0.01F, 0.01F, 0.01F}, {1.0F, 0.0F, 0.0F}, {0.03F, 0.01F, 0.01F}};
  map.colors = {{10, 0, 0}, {50, 50, 50}, {40, 0, 0}};
  map.normals = {{0.0F, 0.0F, -1.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, -1.0F}};
  map.observations = {1, 5, 2};
  return map;
}

TEST(MapCloud, PointsOfAVoxelBecomeTheirWeightedMean) {
  const MapCloud map = merged(three_points(), 0.1);
  ASSERT_EQ(map.size(), 2U);
  EXPECT_NEAR(map.points[0].x(), 0.07F / 3.0F, 1e-6F);
  EXPECT_EQ(map.colors[0].r, 30);
  EXPECT_NEAR(map.normals[0].z(), -1.0F, 1e-6F);
  EXPECT_EQ(map.observations[0], 3);
  EXPECT_EQ(map.points[1].x(), 1.0F);
  EXPECT_EQ(map.observations[1], 5);
}

TEST(MapCloud, OppositeNormalsAreUnknown) {
  MapCloud map = three_points();
  map.normals[2] = {0.0F, 0.0F, 0.5F};
  EXPECT_EQ(merged(map, 0.1).normals[0], Eigen::Vector3f::Zero());
}

TEST(MapCloud, SmallVoxelsMergeNothing) {
  EXPECT_EQ(merged(three_points(), 0.001).size(), 3U);
  EXPECT_EQ(merged({}, 0.1).size(), 0U);
}

}  // namespace
}  // namespace mms
