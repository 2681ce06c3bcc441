#include "mms/mapping/free_space/scan_free_space.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mms {
namespace {

constexpr double kMargin = 0.1;

/// `count` points at distance `range` in every direction, or in those that `has` accepts.
template <class Has>
LabeledCloud sphere(float range, const Has& has, std::size_t count = 200'000) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  LabeledCloud cloud;
  while (cloud.points.size() < count) {
    const Eigen::Vector3f direction(normal(random), normal(random), normal(random));
    if (has(direction)) cloud.points.push_back(range * direction.normalized());
  }
  cloud.labels.assign(cloud.points.size(), PointLabel::kStatic);
  return cloud;
}

LabeledCloud sphere(float range) {
  return sphere(range, [](const Eigen::Vector3f&) { return true; });
}

TEST(ScanFreeSpace, EndsAtPointsInAllDirections) {
  const ScanFreeSpace space(sphere(5.0F), kMargin);
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3f direction =
        Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
    EXPECT_EQ(space.state_at(4.85F * direction), SpaceState::kFree);
    EXPECT_EQ(space.state_at(4.95F * direction), SpaceState::kSurface);
    EXPECT_EQ(space.state_at(5.05F * direction), SpaceState::kSurface);
    EXPECT_NE(space.state_at(5.2F * direction), SpaceState::kSurface);
    EXPECT_NE(space.state_at(6.0F * direction), SpaceState::kNoReturn);
  }
}

TEST(ScanFreeSpace, EndsAtNearestNeighborPoint) {
  LabeledCloud cloud = sphere(5.0F);
  cloud.points.emplace_back(2.0F, 0.0F, 0.0F);
  cloud.labels.push_back(PointLabel::kDynamic);  // occludes the space behind it
  const ScanFreeSpace space(cloud, kMargin);
  EXPECT_NE(space.state_at({3.0F, 0.0F, 0.0F}), SpaceState::kFree);
  EXPECT_NE(space.state_at({3.0F, 0.05F, 0.0F}), SpaceState::kFree);
  EXPECT_EQ(space.state_at({3.0F, 0.3F, 0.0F}), SpaceState::kFree);
  EXPECT_EQ(space.state_at({1.5F, 0.0F, 0.0F}), SpaceState::kFree);
}

TEST(ScanFreeSpace, HasNarrowDirectionsInDenseScans) {
  LabeledCloud cloud = sphere(
      5.0F, [](const Eigen::Vector3f&) { return true; }, 600'000);
  cloud.points.emplace_back(2.0F, 0.01F, 0.01F);
  cloud.labels.push_back(PointLabel::kStatic);
  const ScanFreeSpace space(cloud, kMargin);
  EXPECT_NE(space.state_at({3.0F, 0.0F, 0.0F}), SpaceState::kFree);
  EXPECT_EQ(space.state_at({3.0F, 0.09F, 0.0F}), SpaceState::kFree);  // 1.7 degrees beside
}

TEST(ScanFreeSpace, IsUnknownWithoutReturns) {
  LabeledCloud cloud = sphere(5.0F, [](const Eigen::Vector3f& d) { return d.x() < 0.0F; });
  cloud.points.emplace_back(1.0F, 1.0F, 1.0F);
  cloud.labels.push_back(PointLabel::kInvalid);
  const ScanFreeSpace space(cloud, kMargin);
  EXPECT_EQ(space.state_at({2.0F, 0.0F, 0.0F}), SpaceState::kNoReturn);
  EXPECT_EQ(space.state_at({0.5F, 0.5F, 0.5F}), SpaceState::kNoReturn);
  EXPECT_EQ(space.state_at({-2.0F, 0.0F, 0.0F}), SpaceState::kFree);
}

}  // namespace
}  // namespace mms
