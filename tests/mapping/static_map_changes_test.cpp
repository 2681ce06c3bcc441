#include <gtest/gtest.h>

#include <map>

#include "mms/core/error.hpp"
#include "mms/mapping/static_map/static_map.hpp"
#include "tests/mapping/synthetic_cloud.hpp"

namespace mms {
namespace {

using test::organised_cloud;
using test::pose;

/// A wall at 3 m and, in every third keyframe, a box in front of it that the others see through.
LabeledCloud keyframe_cloud(int index) {
  return organised_cloud([=](int x, int, const Eigen::Vector3f&) {
    return index % 3 == 0 && x >= 60 && x < 100 ? 1.5F : 3.0F;
  });
}

Transform<World, Sensor> keyframe_pose(int index) {
  return pose({0.04 * index, 0.02 * index, 0.0}, 0.02 * index);
}

using VoxelIndices = std::map<VoxelKey, std::size_t>;  // voxel, index into the cloud

VoxelIndices voxel_indices(const StaticMap& map, const MapCloud& cloud) {
  VoxelIndices voxels;
  const auto inverse = static_cast<float>(1.0 / map.voxel_size());
  for (std::size_t i = 0; i < cloud.size(); ++i) voxels[voxel_key(cloud.points[i], inverse)] = i;
  return voxels;
}

void expect_same_surface(const StaticMap& map, const StaticMap& replayed) {
  ASSERT_EQ(map.voxel_size(), replayed.voxel_size());
  const MapCloud cloud = map.cloud();
  const MapCloud copy = replayed.cloud();
  ASSERT_EQ(cloud.size(), copy.size());
  const VoxelIndices voxels = voxel_indices(map, cloud);
  std::size_t missing = 0;  // rounding may move a mean on a voxel's side into the neighbor
  std::size_t moved = 0;    // a voxel with two surfaces may later get more points of the other
  for (const auto& [key, j] : voxel_indices(replayed, copy)) {
    const auto found = voxels.find(key);
    if (found == voxels.end()) {
      ++missing;
      continue;
    }
    const std::size_t i = found->second;
    EXPECT_LE(copy.observations[j], cloud.observations[i]);
    EXPECT_GT(2 * copy.observations[j], cloud.observations[i]);
    const bool is_rotated = !cloud.normals[i].isZero() && !copy.normals[j].isZero() &&
                            cloud.normals[i].dot(copy.normals[j]) < 0.9F;
    const float distance = (cloud.points[i] - copy.points[j]).norm();
    if (is_rotated || distance > 0.5 * map.voxel_size()) ++moved;
  }
  EXPECT_LE(missing, cloud.size() / 100);
  EXPECT_LE(moved, cloud.size() / 500);
}

/// After every keyframe, the changes so far reproduce the map.
/// @param between  frames before each keyframe
void expect_changes_suffice(const StaticMapConfig& config, int keyframes, int between = 0) {
  StaticMap map(config);
  StaticMap replayed(config);
  for (int i = 0; i < keyframes; ++i) {
    for (int k = 0; k < between; ++k) map.add(keyframe_cloud(i + k), keyframe_pose(i));
    map.integrate(keyframe_cloud(i), keyframe_pose(i));
    replayed.apply(map.changes());
    SCOPED_TRACE("keyframe " + std::to_string(i));
    expect_same_surface(map, replayed);
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(replayed.views(), map.views());
}

TEST(StaticMapChanges, IncludeFramesAfterLastKeyframe) {
  StaticMap map;
  StaticMap replayed;
  map.integrate(keyframe_cloud(0), keyframe_pose(0));
  replayed.apply(map.changes());
  EXPECT_FALSE(map.finalize());
  map.add(keyframe_cloud(1), keyframe_pose(3));
  map.add(keyframe_cloud(2), keyframe_pose(4));
  EXPECT_GT(map.cloud().size(), replayed.cloud().size());
  EXPECT_TRUE(map.finalize());
  replayed.apply(map.changes());
  expect_same_surface(map, replayed);
}

TEST(StaticMapChanges, ReproduceMap) {
  expect_changes_suffice({}, 12);
}

TEST(StaticMapChanges, IncludeFramesBeforeKeyframe) {
  expect_changes_suffice({}, 8, 2);
  expect_changes_suffice({.min_observations = 3}, 8, 3);
}

TEST(StaticMapChanges, ReproduceMapForAnyMinObservations) {
  expect_changes_suffice({.min_observations = 1}, 8);
  expect_changes_suffice({.min_observations = 3}, 8);
  expect_changes_suffice({.min_observations = 7}, 10);
}

TEST(StaticMapChanges, ContainWholeMapAfterCoarsening) {
  StaticMapConfig config{.voxel_size = 0.01, .memory = 3.0};
  expect_changes_suffice(config, 6);
  StaticMap map(config);
  bool whole = false;
  for (int i = 0; i < 6; ++i) {
    map.integrate(keyframe_cloud(i), keyframe_pose(i));
    whole = whole || map.changes().whole;
  }
  EXPECT_TRUE(whole);
  EXPECT_GT(map.voxel_size(), config.voxel_size);
}

TEST(StaticMapChanges, ContainCarvedVoxels) {
  StaticMap map({.min_observations = 1});
  map.integrate(keyframe_cloud(0), keyframe_pose(0));
  std::size_t erased = 0;
  for (int i = 1; i < 4; ++i) {
    const std::size_t carved = map.integrate(keyframe_cloud(1), keyframe_pose(0)).carved;
    EXPECT_EQ(map.changes().erased.size(), carved);
    erased += carved;
  }
  EXPECT_GT(erased, 500U);
}

TEST(StaticMapChanges, GetRareForStaticSensor) {
  StaticMap map;
  std::size_t changed = 0;
  for (int i = 0; i < 64; ++i) {
    map.integrate(keyframe_cloud(1), keyframe_pose(0));
    changed += map.changes().voxels.size();
  }
  EXPECT_LE(changed, 7 * map.size());  // at 1, 2, 4, ... 64 observations
}

TEST(StaticMapChanges, AreEmptyForEmptyMap) {
  const StaticMap map;
  EXPECT_TRUE(map.changes().blocks.empty());
  EXPECT_EQ(map.changes().voxel_size, map.voxel_size());
}

TEST(StaticMapChanges, RejectCellOutsideBlock) {
  MapChanges changes;
  changes.voxel_size = 0.02;
  changes.blocks = {{{0, 0, 0}, 1, 1}};
  changes.voxels = {VoxelChange{.cell = 512, .hits = 1}};
  StaticMap map;
  EXPECT_THROW(map.apply(changes), DataError);
}

}  // namespace
}  // namespace mms
