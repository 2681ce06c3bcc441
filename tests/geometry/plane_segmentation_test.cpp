#include "mms/geometry/plane_segmentation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace mms {
namespace {

/// Samples of a rectangle spanned by `u` and `v` [m] from `corner`, 5 cm apart.
void add_rectangle(std::vector<PlaneSample>& samples, const Eigen::Vector3f& corner,
                   const Eigen::Vector3f& u, const Eigen::Vector3f& v, float noise,
                   std::mt19937& random) {
  constexpr float kSpacing = 0.05F;
  std::normal_distribution<float> gauss(0.0F, noise);
  const Eigen::Vector3f normal = u.cross(v).normalized();
  for (float a = 0.0F; a < u.norm(); a += kSpacing) {
    for (float b = 0.0F; b < v.norm(); b += kSpacing) {
      const Eigen::Vector3f tilt(gauss(random), gauss(random), gauss(random));
      const Eigen::Vector3f point =
          corner + a * u.normalized() + b * v.normalized() + gauss(random) * normal;
      const Eigen::Vector3f tilted = (normal + 5.0F * tilt).normalized();
      samples.push_back({point, tilted, kSpacing * kSpacing, 0.03F});
    }
  }
}

TEST(PlaneSegmentation, FindsFloorAndWallNotTorso) {
  std::mt19937 random(5);
  std::vector<PlaneSample> samples;
  add_rectangle(samples, {-1, 1, 2}, {2, 0, 0}, {0, 0, 2}, 0.01F, random);
  add_rectangle(samples, {-1, -1, 4}, {2, 0, 0}, {0, 2, 0}, 0.01F, random);
  add_rectangle(samples, {0, 0, 2.5F}, {0.2F, 0, 0}, {0, 0.6F, 0}, 0.01F, random);
  const std::vector<Plane> planes = find_planes(samples, PlaneSearch{});
  ASSERT_EQ(planes.size(), 2U);
  const bool floor_first = std::abs(planes[0].normal.y()) > 0.9F;
  const Plane& floor = planes[floor_first ? 0 : 1];
  const Plane& wall = planes[floor_first ? 1 : 0];
  EXPECT_GT(std::abs(floor.normal.y()), 0.9995F);
  EXPECT_NEAR(std::abs(floor.offset), 1.0F, 0.02F);
  EXPECT_GT(std::abs(wall.normal.z()), 0.9995F);
  EXPECT_NEAR(std::abs(wall.offset), 4.0F, 0.05F);
}

TEST(PlaneSegmentation, DoesNotMergeStairs) {
  std::mt19937 random(6);
  std::vector<PlaneSample> samples;
  for (int k = 0; k < 6; ++k) {
    const auto i = static_cast<float>(k);
    add_rectangle(samples, {-0.6F, -0.3F * i, 2.0F + 0.3F * i}, {1.2F, 0, 0}, {0, 0, 0.3F}, 0.003F,
                  random);
  }
  for (const Plane& plane : find_planes(samples, PlaneSearch{})) {
    EXPECT_GT(std::abs(plane.normal.y()), 0.98F);
  }
}

TEST(PlaneSegmentation, NoPlanesWithoutValidSamples) {
  EXPECT_TRUE(find_planes({}, PlaneSearch{}).empty());
  const PlaneSample unknown{Eigen::Vector3f::UnitZ(), Eigen::Vector3f::Zero(), 1.0F, 0.1F};
  EXPECT_TRUE(find_planes({unknown, unknown, unknown}, PlaneSearch{}).empty());
}

}  // namespace
}  // namespace mms
