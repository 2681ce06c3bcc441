#include "mms/geometry/clustering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mms {
namespace {

/// Connected components over all pairs that `linked` accepts.
template <class Linked>
Clusters flood(std::size_t count, const std::vector<std::uint8_t>& use, const ClusterSize& size,
               const Linked& linked) {
  Clusters clusters;
  clusters.label.assign(count, Clusters::kNone);
  std::vector<bool> visited(count, false);
  for (std::size_t seed = 0; seed < count; ++seed) {
    if (visited[seed] || use[seed] == 0) continue;
    std::vector<std::size_t> members{seed};
    visited[seed] = true;
    for (std::size_t k = 0; k < members.size(); ++k) {
      for (std::size_t j = 0; j < count; ++j) {
        if (visited[j] || use[j] == 0 || !linked(members[k], j)) continue;
        visited[j] = true;
        members.push_back(j);
      }
    }
    const int n = static_cast<int>(members.size());
    if (n < size.min_points || n > size.max_points) continue;
    for (const std::size_t i : members) clusters.label[i] = clusters.count;
    ++clusters.count;
  }
  return clusters;
}

std::vector<Eigen::Vector3f> random_points(std::mt19937& random, std::size_t count, float side) {
  std::uniform_real_distribution<float> uniform(-side, side);
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(uniform(random), uniform(random), uniform(random));
  }
  return points;
}

std::vector<std::uint8_t> random_keep(std::mt19937& random, std::vector<Eigen::Vector3f>& points,
                                      std::vector<std::uint8_t>& use) {
  std::vector<std::uint8_t> keep(points.size(), 1);
  use.assign(points.size(), 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (random() % 10 == 0) keep[i] = use[i] = 0;
    if (random() % 15 != 0) continue;
    points[i].setConstant(std::nanf(""));
    use[i] = 0;
  }
  return keep;
}

TEST(Clustering, PointsEqualBruteForce) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    auto points = random_points(random, 400, 1.0F);
    std::vector<std::uint8_t> use;
    const auto keep = random_keep(random, points, use);
    const float tolerance = 0.08F + 0.01F * static_cast<float>(trial);
    const ClusterSize size{trial % 4, 100};
    const Clusters expected = flood(points.size(), use, size, [&](auto i, auto j) {
      return (points[i] - points[j]).squaredNorm() <= tolerance * tolerance;
    });
    const Clusters found = cluster_points(points, keep, tolerance, size);
    EXPECT_EQ(found.count, expected.count);
    EXPECT_EQ(found.label, expected.label);
  }
}

TEST(Clustering, GridEqualsBruteForce) {
  std::mt19937 random(2);
  constexpr int kWidth = 23;
  for (int trial = 0; trial < 20; ++trial) {
    auto points = random_points(random, kWidth * 17, 0.2F);
    std::vector<float> tolerance(points.size());
    for (auto& t : tolerance) t = 0.05F + 0.0001F * static_cast<float>(random() % 1000);
    std::vector<std::uint8_t> use;
    const auto keep = random_keep(random, points, use);
    const ClusterSize size{trial % 3, 200};
    const Clusters expected = flood(points.size(), use, size, [&](auto i, auto j) {
      const int dx = std::abs(static_cast<int>(i % kWidth) - static_cast<int>(j % kWidth));
      const int dy = std::abs(static_cast<int>(i / kWidth) - static_cast<int>(j / kWidth));
      const bool is_near = std::max(dx, dy) <= 1 || (std::min(dx, dy) == 0 && dx + dy == 2);
      const float limit = std::max(tolerance[i], tolerance[j]);
      return is_near && (points[i] - points[j]).squaredNorm() <= limit * limit;
    });
    const Clusters found = cluster_grid(points, kWidth, keep, tolerance, size);
    EXPECT_EQ(found.count, expected.count);
    EXPECT_EQ(found.label, expected.label);
  }
}

TEST(Clustering, NoClustersWithoutPoints) {
  EXPECT_EQ(cluster_points({}, {}, 0.1F).count, 0);
  EXPECT_EQ(cluster_grid({}, 4, {}, {}).count, 0);
}

}  // namespace
}  // namespace mms
