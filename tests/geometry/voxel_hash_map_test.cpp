#include "mms/geometry/voxels/voxel_hash_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

namespace mms {
namespace {

TEST(VoxelKey, RoundsDownOnBothSidesOfOrigin) {
  const VoxelHashMap<int> map(0.5, 10);
  EXPECT_EQ(map.key({0.0F, 0.49F, 0.5F}), (VoxelKey{0, 0, 1}));
  EXPECT_EQ(map.key({-0.01F, -0.5F, -0.51F}), (VoxelKey{-1, -1, -2}));
  EXPECT_TRUE(map.voxel_centre({-1, 0, 2}).isApprox(Eigen::Vector3f(-0.25F, 0.25F, 1.25F)));
}

TEST(VoxelKey, HashSpreadsNeighbors) {
  std::set<std::size_t> low_bits;
  for (int x = -8; x < 8; ++x) {
    for (int y = -8; y < 8; ++y) {
      for (int z = -8; z < 8; ++z) low_bits.insert(VoxelKeyHash{}({x, y, z}) & 0xFFFU);
    }
  }
  // 4096 random keys fill 63 % of 4096 slots.
  EXPECT_GT(low_bits.size(), 2400U);
}

TEST(VoxelHashMap, EqualsStdMap) {
  VoxelHashMap<int> map(1.0, 100000);
  std::map<VoxelKey, int> expected;
  std::mt19937 random(5);
  std::uniform_int_distribution<int> coordinate(-6, 6);
  for (int i = 0; i < 5000; ++i) {
    const VoxelKey key{coordinate(random), coordinate(random), coordinate(random)};
    map.touch(key) += i;
    expected[key] += i;
    if (i % 1000 == 999) {
      const auto odd = [](int value) { return value % 2 != 0; };
      map.remove_if([&](const auto& entry) { return odd(entry.cell); });
      std::erase_if(expected, [&](const auto& entry) { return odd(entry.second); });
    }
  }
  ASSERT_EQ(map.size(), expected.size());
  for (const auto& [key, value] : expected) {
    ASSERT_NE(map.find(key), nullptr);
    EXPECT_EQ(*map.find(key), value);
  }
  EXPECT_EQ(map.find({100, 0, 0}), nullptr);
}

TEST(VoxelHashMap, BoundKeepsMostRecentlyWritten) {
  constexpr int kBound = 50;
  VoxelHashMap<int> map(1.0, kBound);
  for (int i = 0; i < 200; ++i) map.touch({i, 0, 0}) = i;
  map.touch({0, 0, 0}) = -1;  // the oldest cell is the latest written
  EXPECT_EQ(map.size(), 200U);
  map.enforce_bound();
  EXPECT_LE(map.size(), static_cast<std::size_t>(kBound));
  EXPECT_GE(map.size(), static_cast<std::size_t>(kBound * 9 / 10));
  EXPECT_NE(map.find({0, 0, 0}), nullptr);
  for (int i = 200 - kBound * 8 / 10; i < 200; ++i) EXPECT_NE(map.find({i, 0, 0}), nullptr) << i;
  for (int i = 1; i < 200 - kBound; ++i) EXPECT_EQ(map.find({i, 0, 0}), nullptr) << i;
}

TEST(VoxelHashMap, RemovesNothingWithinBound) {
  VoxelHashMap<int> map(1.0, 50);
  for (int i = 0; i < 50; ++i) map.touch({i, 0, 0}) = i;
  map.enforce_bound();
  EXPECT_EQ(map.size(), 50U);
}

TEST(VoxelHashMap, EnforcesSmallBounds) {
  for (const std::size_t bound : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    VoxelHashMap<int> map(1.0, bound);
    for (int i = 0; i < 5; ++i) map.touch({i, 0, 0}) = i;
    map.enforce_bound();
    EXPECT_EQ(map.size(), std::max<std::size_t>(1, bound));
    EXPECT_NE(map.find({4, 0, 0}), nullptr);
  }
}

TEST(VoxelHashMap, RemovesByDistanceOfCenters) {
  VoxelHashMap<int> map(1.0, 1000);
  for (int x = -10; x < 10; ++x) map.touch({x, 0, 0}) = x;
  map.remove_farther_than({0.5F, 0.5F, 0.5F}, 3.0F);
  EXPECT_EQ(map.size(), 7U);
  for (int x = -3; x <= 3; ++x) EXPECT_NE(map.find({x, 0, 0}), nullptr);
  map.clear();
  EXPECT_TRUE(map.empty());
  EXPECT_EQ(map.find({0, 0, 0}), nullptr);
}

TEST(VoxelHashMap, SameInsertionsGiveSameOrder) {
  const auto build = [] {
    VoxelHashMap<int> map(1.0, 300);
    std::mt19937 random(9);
    std::uniform_int_distribution<int> coordinate(-20, 20);
    for (int i = 0; i < 2000; ++i) {
      map.touch({coordinate(random), coordinate(random), 0}) = i;
      map.enforce_bound();
    }
    return map;
  };
  const auto a = build();
  const auto b = build();
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LE(a.size(), 300U);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a.entries()[i].key, b.entries()[i].key);
}

}  // namespace
}  // namespace mms
