#include "mms/geometry/voxels/voxel_ray.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "mms/core/random_stream.hpp"

namespace mms {
namespace {

std::vector<VoxelKey> voxels_between(const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  std::vector<VoxelKey> keys;
  for_each_voxel(from, to, [&](const VoxelKey& key) {
    keys.push_back(key);
    return true;
  });
  return keys;
}

int manhattan(const VoxelKey& a, const VoxelKey& b) {
  return std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z);
}

Eigen::Vector3f random_point(RandomStream& random, float reach) {
  return {random.between(-reach, reach), random.between(-reach, reach),
          random.between(-reach, reach)};
}

/// Distance of a point from the voxel, 0 inside.
float distance(const Eigen::Vector3f& point, const VoxelKey& key) {
  const Eigen::Array3f low(static_cast<float>(key.x), static_cast<float>(key.y),
                           static_cast<float>(key.z));
  return (point.array() - point.array().max(low).min(low + 1.0F)).matrix().norm();
}

/// Least distance of the segment's points from the voxel, by sampling.
float distance(const Eigen::Vector3f& from, const Eigen::Vector3f& to, const VoxelKey& key) {
  float least = 1e9F;
  for (int i = 0; i <= 4000; ++i) {
    const float share = static_cast<float>(i) / 4000.0F;
    least = std::min(least, distance(Eigen::Vector3f(from + share * (to - from)), key));
  }
  return least;
}

TEST(VoxelRay, IsFaceConnectedFromEndToEnd) {
  RandomStream random(1);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3f from = random_point(random, 30.0F);
    const Eigen::Vector3f to = random_point(random, 30.0F);
    const auto keys = voxels_between(from, to);
    EXPECT_EQ(keys.front(), voxel_key(from, 1.0F));
    EXPECT_EQ(keys.back(), voxel_key(to, 1.0F));
    EXPECT_EQ(static_cast<int>(keys.size()), manhattan(keys.front(), keys.back()) + 1);
    for (std::size_t k = 1; k < keys.size(); ++k) EXPECT_EQ(manhattan(keys[k - 1], keys[k]), 1);
  }
}

TEST(VoxelRay, ContainsAllSampledVoxels) {
  RandomStream random(2);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f from = random_point(random, 10.0F);
    const Eigen::Vector3f to = random_point(random, 10.0F);
    const auto keys = voxels_between(from, to);
    const std::set<VoxelKey> found(keys.begin(), keys.end());
    for (int k = 0; k <= 5000; ++k) {
      const Eigen::Vector3f point = from + static_cast<float>(k) / 5000.0F * (to - from);
      // On a border, rounding decides.
      const Eigen::Array3f from_border = (point.array() - point.array().round()).abs();
      if (from_border.minCoeff() < 1e-4F) continue;
      EXPECT_TRUE(found.contains(voxel_key(point, 1.0F)));
    }
  }
}

TEST(VoxelRay, ContainsOnlyTouchedVoxels) {
  RandomStream random(3);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3f from = random_point(random, 5.0F);
    const Eigen::Vector3f to = random_point(random, 5.0F);
    for (const VoxelKey& key : voxels_between(from, to)) {
      EXPECT_LT(distance(from, to, key), 5e-3F);
    }
  }
}

TEST(VoxelRay, AxisAlignedRayIsStraight) {
  const auto keys = voxels_between({0.5F, 0.5F, 0.5F}, {-3.5F, 0.5F, 0.5F});
  ASSERT_EQ(keys.size(), 5U);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(keys[static_cast<std::size_t>(i)], (VoxelKey{-i, 0, 0}));
  }
}

TEST(VoxelRay, ReachesEndOnBordersAndCorners) {
  for (const float x : {-2.0F, 0.0F, 2.0F}) {
    for (const float y : {-2.0F, 0.0F, 2.0F}) {
      for (const float z : {-2.0F, 0.0F, 2.0F}) {
        const auto keys = voxels_between({0, 0, 0}, {x, y, z});
        EXPECT_EQ(keys.back(), voxel_key({x, y, z}, 1.0F));
        const auto back = voxels_between({x, y, z}, {0, 0, 0});
        EXPECT_EQ(back.back(), (VoxelKey{0, 0, 0}));
      }
    }
  }
}

TEST(VoxelRay, StaysInOneVoxel) {
  EXPECT_EQ(voxels_between({0.2F, 0.3F, 0.4F}, {0.2F, 0.3F, 0.4F}).size(), 1U);
  EXPECT_EQ(voxels_between({0.2F, 0.3F, 0.4F}, {0.9F, 0.8F, 0.7F}).size(), 1U);
}

}  // namespace
}  // namespace mms
