#include "mms/simulation/sensors/ray_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/simulation/models/mesh_shapes.hpp"

namespace mms {
namespace {

using Eigen::Vector3f;

Mesh box_mesh(const Vector3f& half) {
  Mesh mesh;
  add_box(mesh, at(0.0F, 0.0F, 0.0F), half, mesh.add({}));
  return mesh;
}

/// Entry distance of a ray into a box around the origin (slab method), or infinity.
double entry(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
             const Eigen::Vector3d& half) {
  double enter = 0.0;
  double leave = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (-half[axis] - origin[axis]) / direction[axis];
    const double b = (half[axis] - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : std::numeric_limits<double>::infinity();
}

std::vector<Ray> random_rays(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> aim(-1.5F, 1.5F);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const Vector3f origin(-15.0F + aim(random), aim(random), aim(random));
    const Vector3f target(aim(random), aim(random), aim(random));
    rays.push_back({origin, (target - origin).normalized()});
  }
  return rays;
}

TEST(RayScene, DistancesEqualAnalyticBox) {
  const Vector3f half(0.7F, 0.4F, 1.1F);
  const RayScene scene(box_mesh(half), {});
  const std::vector<Ray> rays = random_rays(1003);
  std::vector<RayHit> hits(rays.size());
  scene.cast(rays, hits);
  int found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double exact =
        entry(rays[i].origin.cast<double>(), rays[i].direction.cast<double>(), half.cast<double>());
    ASSERT_EQ(hits[i].valid(), std::isfinite(exact)) << i;
    if (!hits[i].valid()) continue;
    ++found;
    EXPECT_NEAR(static_cast<double>(hits[i].distance), exact, 1e-5);
    EXPECT_EQ(hits[i].part, 0);
  }
  EXPECT_GT(found, 200);
}

TEST(RayScene, PartsAreAtLastPlacement) {
  const Mesh wall = box_mesh({0.1F, 5.0F, 5.0F});
  const Mesh cube = box_mesh({0.2F, 0.2F, 0.2F});
  const std::vector<const Mesh*> parts = {&cube, &cube};
  RayScene scene(wall, parts);
  const std::vector<Ray> rays = {{{-5.0F, 0.0F, 0.0F}, Vector3f::UnitX()}};
  std::vector<RayHit> hits(1);
  scene.place(std::vector{at(-2.0F, 3.0F, 0.0F), at(-3.0F, 0.0F, 0.0F)});
  scene.cast(rays, hits);
  EXPECT_EQ(hits[0].part, 2);
  EXPECT_NEAR(hits[0].distance, 1.8F, 1e-5F);
  scene.place(std::vector{at(-2.0F, 0.0F, 0.0F), at(-3.0F, 3.0F, 0.0F)});
  scene.cast(rays, hits);
  EXPECT_EQ(hits[0].part, 1);
  EXPECT_NEAR(hits[0].distance, 2.8F, 1e-5F);
  scene.place(std::vector{at(-2.0F, 3.0F, 0.0F), at(-3.0F, 3.0F, 0.0F)});
  scene.cast(rays, hits);
  EXPECT_EQ(hits[0].part, 0);
}

TEST(RayScene, CastsAtSelectedParts) {
  const Mesh wall = box_mesh({0.1F, 5.0F, 5.0F});
  const Mesh cube = box_mesh({0.2F, 0.2F, 0.2F});
  const std::vector<const Mesh*> parts = {&cube, &cube};
  RayScene scene(wall, parts);
  scene.place(std::vector{at(2.0F, 0.0F, 0.0F), at(4.0F, 0.0F, 0.0F)});  // both behind the wall
  const std::vector<Ray> rays = {{{-5.0F, 0.0F, 0.0F}, Vector3f::UnitX()}};
  std::vector<RayHit> hits(1);
  scene.cast_at_parts(rays, 1, 2, hits);
  EXPECT_EQ(hits[0].part, 2);
  EXPECT_NEAR(hits[0].distance, 8.8F, 1e-5F);
  scene.cast_at_parts(rays, 0, 0, hits);
  EXPECT_FALSE(hits[0].valid());
}

TEST(RayScene, BlockedOnlyWithinReach) {
  const RayScene scene(box_mesh({0.1F, 5.0F, 5.0F}), {});
  const std::vector<Ray> rays = {{{-5.0F, 0.0F, 0.0F}, Vector3f::UnitX(), 4.8F},
                                 {{-5.0F, 0.0F, 0.0F}, Vector3f::UnitX(), 5.0F},
                                 {{-5.0F, 0.0F, 0.0F}, -Vector3f::UnitX()}};
  std::vector<std::uint8_t> blocked(rays.size());
  scene.blocked(rays, blocked);
  EXPECT_EQ(blocked, (std::vector<std::uint8_t>{0, 1, 0}));
}

TEST(RayScene, NeedsPoseForEveryPart) {
  RayScene scene(box_mesh({1.0F, 1.0F, 1.0F}), {});
  EXPECT_THROW(scene.place(std::vector{at(0.0F, 0.0F, 0.0F)}), Error);
}

}  // namespace
}  // namespace mms
