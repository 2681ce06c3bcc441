#include "mms/geometry/voxels/point_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

namespace mms {
namespace {

using Points = std::vector<Eigen::Vector3f>;

constexpr PointMap::Limits kUnlimited{.max_points_per_voxel = 1 << 30};

Points random_points(int count, float half_side, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> any(-half_side, half_side);
  Points points;
  for (int i = 0; i < count; ++i) points.push_back({any(random), any(random), any(random)});
  return points;
}

/// Expected result of `within`, by brute force.
std::vector<Neighbor> all_within(const Points& points, const Eigen::Vector3f& query, float radius) {
  std::vector<Neighbor> found;
  for (const Eigen::Vector3f& p : points) {
    const float distance2 = (p - query).squaredNorm();
    if (distance2 <= radius * radius) found.push_back({p, distance2});
  }
  std::sort(found.begin(), found.end(), [](const Neighbor& a, const Neighbor& b) {
    return std::tie(a.squared_distance, a.point.x(), a.point.y(), a.point.z()) <
           std::tie(b.squared_distance, b.point.x(), b.point.y(), b.point.z());
  });
  return found;
}

/// The same distances in the same order; the last digit may depend on how the compiler rounds.
void expect_same_distances(const std::vector<Neighbor>& actual,
                           const std::vector<Neighbor>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    EXPECT_FLOAT_EQ(actual[i].squared_distance, expected[i].squared_distance);
    EXPECT_GE(actual[i].squared_distance, actual[i == 0 ? 0 : i - 1].squared_distance);
  }
}

/// The same points in any order.
void expect_same_points(std::vector<Neighbor> actual, std::vector<Neighbor> expected) {
  ASSERT_EQ(actual.size(), expected.size());
  const auto by_coordinates = [](const Neighbor& a, const Neighbor& b) {
    return std::tie(a.point.x(), a.point.y(), a.point.z()) <
           std::tie(b.point.x(), b.point.y(), b.point.z());
  };
  std::sort(actual.begin(), actual.end(), by_coordinates);
  std::sort(expected.begin(), expected.end(), by_coordinates);
  for (std::size_t i = 0; i < actual.size(); ++i) EXPECT_EQ(actual[i].point, expected[i].point);
}

/// Voxel size and radius [m].
class PointMapSearch : public ::testing::TestWithParam<std::tuple<double, float>> {};
INSTANTIATE_TEST_SUITE_P(Sizes, PointMapSearch,
                         ::testing::Combine(::testing::Values(0.07, 0.25, 1.0, 10.0),
                                            ::testing::Values(0.02F, 0.2F, 0.5F, 1.3F)));

TEST_P(PointMapSearch, EqualsBruteForce) {
  const auto [voxel_size, radius] = GetParam();
  const Points points = random_points(1500, 1.5F, 11);
  PointMap map(voxel_size, kUnlimited);
  map.insert(points);
  std::vector<Neighbor> found;
  for (const Eigen::Vector3f& query : random_points(60, 1.8F, 12)) {
    const auto expected = all_within(points, query, radius);
    map.within(query, radius, found);
    expect_same_points(found, expected);
    expect_same_distances(found, expected);
    for (const std::size_t k : {1U, 3U, 10U}) {
      map.nearest(query, k, radius, found);
      const auto count = static_cast<std::ptrdiff_t>(std::min(k, expected.size()));
      expect_same_distances(found, {expected.begin(), expected.begin() + count});
      for (const Neighbor& n : found) {
        EXPECT_FLOAT_EQ((n.point - query).squaredNorm(), n.squared_distance);
      }
    }
  }
}

TEST(PointMap, EmptyMapFindsNothing) {
  const PointMap map(0.1, {});
  std::vector<Neighbor> found(3);
  map.within({0.0F, 0.0F, 0.0F}, 1.0F, found);
  EXPECT_TRUE(found.empty());
  map.nearest({0.0F, 0.0F, 0.0F}, 5, 1.0F, found);
  EXPECT_TRUE(found.empty());
}

TEST(PointMap, BreaksTiesByCoordinates) {
  const Points ring = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  Points reversed(ring.rbegin(), ring.rend());
  PointMap a(0.5, kUnlimited);
  PointMap b(0.5, kUnlimited);
  a.insert(ring);
  b.insert(reversed);
  std::vector<Neighbor> in_a;
  std::vector<Neighbor> in_b;
  a.nearest({0.0F, 0.0F, 0.0F}, 3, 2.0F, in_a);
  b.nearest({0.0F, 0.0F, 0.0F}, 3, 2.0F, in_b);
  ASSERT_EQ(in_a.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(in_a[i].point, in_b[i].point);
}

TEST(PointMap, LimitsPointsPerVoxel) {
  PointMap map(1.0, {.max_points_per_voxel = 4});
  const Points points = random_points(1000, 1.0F, 3);  // 8 voxels
  map.insert(points);
  EXPECT_EQ(map.size(), 32U);
  map.insert(points);
  EXPECT_EQ(map.size(), 32U);
  EXPECT_EQ(map.points().size(), 32U);
}

TEST(PointMap, KeepsMinimumSpacingInVoxel) {
  PointMap map(1.0, {.max_points_per_voxel = 1000, .min_spacing = 0.2F});
  map.insert(random_points(3000, 0.999F, 4));
  EXPECT_GT(map.size(), 8U * 20U);
  const VoxelHashMap<int> grid(1.0, 10);
  const Points kept = map.points();
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (grid.key(kept[i]) != grid.key(kept[j])) continue;
      EXPECT_GE((kept[i] - kept[j]).norm(), 0.2F);
    }
  }
}

TEST(PointMap, IgnoresNonFinitePoints) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  PointMap map(0.1, kUnlimited);
  map.insert({{nan, 0, 0}, {0, nan, 0}, {0, 0, nan}, {inf, 0, 0}, {0, -inf, 0}});
  EXPECT_TRUE(map.empty());
  map.insert({{nan, nan, nan}, {1, 2, 3}});
  EXPECT_EQ(map.size(), 1U);
}

TEST(PointMap, BoundKeepsRecentVoxels) {
  PointMap map(1.0, {.max_points_per_voxel = 20, .max_voxels = 100});
  for (int x = 0; x < 2000; ++x) {
    map.insert({{static_cast<float>(x) + 0.5F, 0.5F, 0.5F}});
    ASSERT_LE(map.size(), 100U);
  }
  std::vector<Neighbor> found;
  map.within({1999.5F, 0.5F, 0.5F}, 50.0F, found);
  EXPECT_EQ(found.size(), 51U);
  map.within({500.5F, 0.5F, 0.5F}, 50.0F, found);
  EXPECT_TRUE(found.empty());
}

TEST(PointMap, RemovesDistantPoints) {
  const double voxel = 0.2;
  PointMap map(voxel, kUnlimited);
  map.insert(random_points(4000, 3.0F, 6));
  const Eigen::Vector3f centre(0.5F, 0.0F, -0.5F);
  const Points before = map.points();
  map.remove_farther_than(centre, 1.5F);
  const Points after = map.points();
  const float tolerance = static_cast<float>(voxel * std::sqrt(3.0) / 2.0);  // centre to corner
  for (const Eigen::Vector3f& p : after) EXPECT_LT((p - centre).norm(), 1.5F + tolerance);
  const auto inner = [&](const Points& points) {
    return std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3f& p) {
      return (p - centre).norm() < 1.5F - tolerance;
    });
  };
  EXPECT_GT(inner(before), 50);
  EXPECT_EQ(inner(after), inner(before));
  std::vector<Neighbor> found;  // the index still agrees with the points
  map.within(centre, 1.0F, found);
  expect_same_points(found, all_within(before, centre, 1.0F));
}

}  // namespace
}  // namespace mms
