#include "mms/geometry/normals.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mms {
namespace {

constexpr int kWidth = 20;

/// Points of the plane z = 2 + slope * x on a grid of rays 0.01 apart.
std::vector<Eigen::Vector3f> slanted_grid(float slope) {
  std::vector<Eigen::Vector3f> points;
  for (int y = 0; y < kWidth; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Eigen::Vector3f ray(0.01F * static_cast<float>(x - 10),
                                0.01F * static_cast<float>(y - 10), 1.0F);
      points.push_back(ray * (2.0F / (1.0F - slope * ray.x())));
    }
  }
  return points;
}

TEST(Normals, GridPatchesOfSlantedPlane) {
  const auto points = slanted_grid(0.5F);
  const auto patches = grid_patches(points, kWidth, 2, 0.5F);
  const SurfacePatch& patch = patches[10 * kWidth + 10];
  const Eigen::Vector3f expected = Eigen::Vector3f(0.5F, 0.0F, -1.0F).normalized();
  EXPECT_GT(patch.normal.dot(expected), 0.9999F);
  EXPECT_NEAR(patch.area, 0.02F * 0.02F * std::sqrt(1.25F), 2e-5F);
  EXPECT_TRUE(patches[0].normal.isZero(0.0F));
}

TEST(Normals, GridPatchesAtGrazingAngle) {
  const auto points = slanted_grid(9.0F);
  ASSERT_GT(points[10 * kWidth + 18].z() - points[10 * kWidth + 16].z(), 2.0F);
  const auto patches = grid_patches(points, kWidth, 2, 0.5F);
  const Eigen::Vector3f expected = Eigen::Vector3f(9.0F, 0.0F, -1.0F).normalized();
  EXPECT_GT(patches[10 * kWidth + 16].normal.dot(expected), 0.9999F);
}

TEST(Normals, GridPatchesStopAtDepthStepsAndHoles) {
  auto points = slanted_grid(0.0F);
  points[10 * kWidth + 12] *= 1.5F;
  points[5 * kWidth + 5].setConstant(std::nanf(""));
  const auto patches = grid_patches(points, kWidth, 2, 0.5F);
  EXPECT_TRUE(patches[10 * kWidth + 10].normal.isZero(0.0F));
  EXPECT_TRUE(patches[5 * kWidth + 5].normal.isZero(0.0F));
  EXPECT_TRUE(patches[5 * kWidth + 7].normal.isZero(0.0F));
}

TEST(Normals, WallHasNormalsAndWireNone) {
  auto points = slanted_grid(0.5F);
  const auto wall = neighbourhood_normals(points, 1, 0.1F);
  const Eigen::Vector3f expected = Eigen::Vector3f(0.5F, 0.0F, -1.0F).normalized();
  EXPECT_GT(wall[10 * kWidth + 10].dot(expected), 0.999F);
  points.clear();
  for (int i = 0; i < 50; ++i) points.emplace_back(0.01F * static_cast<float>(i), 0.0F, 2.0F);
  EXPECT_TRUE(neighbourhood_normals(points, 1, 0.001F)[25].isZero(0.0F));
}

}  // namespace
}  // namespace mms
