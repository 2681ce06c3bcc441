#include "mms/server/scene/map_chunks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/server/scenes.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

/// One voxel at the beginning of a block.
MapChanges one_voxel(const VoxelKey& block, std::uint16_t hits, std::uint16_t views) {
  MapChanges changes;
  changes.voxel_size = 0.1;
  changes.blocks = {{block, views, 1}};
  changes.voxels = {{0, hits, {128, 128, 128}, {}, Rgb{1, 2, 3}}};
  return changes;
}

std::vector<float> sorted_x(const ColoredPoints& cloud) {
  std::vector<float> values;
  for (const Eigen::Vector3f& point : cloud.points) values.push_back(point.x());
  std::sort(values.begin(), values.end());
  return values;
}

TEST(MapChunks, KeepsPointsWithin256thOfVoxel) {
  ColoredPoints cloud = floor_points(30);
  for (Eigen::Vector3f& point : cloud.points) point -= Eigen::Vector3f(1.513F, 0.7F, 2.0F);
  MapChunks map(1);
  map.apply(changes_of(cloud.points, cloud.colors, 0.1));
  const ColoredPoints back = map.cloud();
  ASSERT_EQ(back.points.size(), cloud.points.size());
  const std::vector<float> expected = sorted_x(cloud);
  const std::vector<float> actual = sorted_x(back);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(actual[i], expected[i], 0.1F / 256.0F);
}

TEST(MapChunks, IgnoresInvalidPoints) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Eigen::Vector3f> points = {{nan, 0, 0}, {1e30F, 0, 0}, {1, 1, 1}};
  MapChunks map(1);
  map.apply(changes_of(points, {}, 0.1));
  EXPECT_EQ(map.cloud().points.size(), 1U);
  EXPECT_EQ(map.cloud().colors[0], (Rgb{128, 128, 128}));
}

TEST(MapChunks, DividesIntoCubes) {
  MapChunks map(1);
  map.apply(changes_of(std::vector<Eigen::Vector3f>{{0.05F, 0.05F, 0.05F}, {-0.05F, 0.05F, 0.05F}},
                       {}, 0.1));
  const std::vector<ChunkState> states = map.states();
  ASSERT_EQ(states.size(), 2U);
  EXPECT_EQ(states[0].key, (VoxelKey{-1, 0, 0}));
  EXPECT_EQ(states[1].key, (VoxelKey{0, 0, 0}));
  const float half = 0.1F * MapChunks::kSide / 2.0F;
  EXPECT_NEAR((states[0].center - Eigen::Vector3f(-half, half, half)).norm(), 0.0F, 1e-4F);
}

TEST(MapChunks, LevelsHalveResolutionAndKeepMeans) {
  constexpr int kSide = 16;
  MapChunks map(1);
  map.apply(*floor_map(kSide));
  for (int level = 0; level < MapChunks::kLevels; ++level) {
    const LevelPoints points = map.points({0, 0, 0}, level);
    EXPECT_EQ(points.voxel_size, 0.1 * (1 << level));
    const auto side = static_cast<std::size_t>(kSide >> level);
    ASSERT_EQ(points.cloud.points.size(), side * side) << level;
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    double red = 0.0;
    for (std::size_t i = 0; i < points.cloud.points.size(); ++i) {
      mean += points.cloud.points[i] / static_cast<float>(side * side);
      red += points.cloud.colors[i].r / static_cast<double>(side * side);
    }
    EXPECT_NEAR((mean - Eigen::Vector3f(0.8F, 0.8F, 0.55F)).norm(), 0.0F, 2e-3F);
    EXPECT_NEAR(red, 7.5, 0.5);
  }
}

TEST(MapChunks, ShowsVoxelsLikeStaticMap) {
  MapChunks map(2);
  map.apply(one_voxel({0, 0, 0}, 1, 1));
  EXPECT_EQ(map.cloud().points.size(), 1U) << "observed by the only keyframe";
  map.apply(one_voxel({0, 0, 0}, 1, 10));
  EXPECT_EQ(map.cloud().points.size(), 1U) << "few keyframes observed the block";
  map.apply(one_voxel({0, 0, 0}, 1, 11));
  EXPECT_EQ(map.cloud().points.size(), 0U) << "other keyframes observed the block without it";
  map.apply(one_voxel({0, 0, 0}, 2, 12));
  EXPECT_EQ(map.cloud().points.size(), 1U) << "observed again";
}

TEST(MapChunks, RemovesErasedVoxels) {
  MapChunks map(1);
  map.apply(one_voxel({3, 0, 0}, 1, 1));
  MapChanges erase;
  erase.voxel_size = 0.1;
  erase.erased = {{24, 0, 0}, {1, 1, 1}, {24, 0, 1}};  // the others do not exist
  const std::uint64_t before = map.states().front().version;
  map.apply(erase);
  EXPECT_TRUE(map.states().empty());
  EXPECT_EQ(map.size(), 0U);
  EXPECT_GT(map.version(), before);
}

TEST(MapChunks, WholeMapStaysWhereItsBlocksAreObservedAgain) {
  MapChunks map(2);
  map.apply(*floor_map(8));
  const std::size_t points = map.cloud().points.size();
  map.apply(one_voxel({0, 0, 0}, 8, 40));
  EXPECT_GE(map.cloud().points.size(), points);
}

TEST(MapChunks, WholeMapReplacesFormer) {
  MapChunks map(1);
  map.apply(*floor_map(20));
  MapChanges coarser = changes_of(floor_points(4).points, {}, 0.2);
  map.apply(coarser);
  EXPECT_EQ(map.voxel_size(), 0.2);
  EXPECT_EQ(map.cloud().points.size(), 4U);
}

TEST(MapChunks, IgnoresCellsOutsideBlock) {
  MapChanges invalid = one_voxel({0, 0, 0}, 1, 1);
  invalid.voxels[0].cell = 512;
  MapChunks map(1);
  map.apply(invalid);
  EXPECT_EQ(map.size(), 0U);
}

TEST(MapChunks, OnlyChangedChunksGetNewVersion) {
  MapChunks map(1);
  map.apply(one_voxel({0, 0, 0}, 1, 1));
  map.apply(one_voxel({100, 0, 0}, 1, 1));
  const std::vector<ChunkState> states = map.states();
  ASSERT_EQ(states.size(), 2U);
  EXPECT_EQ(states[0].version, 1U);
  EXPECT_EQ(states[1].version, 2U);
  EXPECT_TRUE(map.points({55, 5, 5}, 0).cloud.points.empty());
}

}  // namespace
}  // namespace mms
