#include "mms/simulation/models/mesh_shapes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace mms {
namespace {

using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;

/// Volume enclosed by a mesh; negative for reversed triangles.
float volume(const Mesh& mesh) {
  float sum = 0.0F;
  for (const Triangle& triangle : mesh.triangles) {
    const auto corner = [&](std::size_t i) { return mesh.vertices[triangle.corners[i]].position; };
    sum += corner(0).dot(corner(1).cross(corner(2))) / 6.0F;
  }
  return sum;
}

/// Every vertex normal of every triangle points to the triangle's outer side.
void expect_normals_outwards(const Mesh& mesh) {
  for (const Triangle& triangle : mesh.triangles) {
    const auto vertex = [&](std::size_t i) { return mesh.vertices[triangle.corners[i]]; };
    const Vector3f face =
        (vertex(1).position - vertex(0).position).cross(vertex(2).position - vertex(0).position);
    if (face.norm() < 1e-7F) continue;  // at the poles of an ellipsoid
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(vertex(i).normal.norm(), 1.0F, 1e-5F);
      EXPECT_GT(vertex(i).normal.dot(face.normalized()), 0.3F);
    }
  }
}

Eigen::Isometry3f sample_pose() {
  Eigen::Isometry3f T = at(0.3F, -0.2F, 0.5F);
  T.rotate(Eigen::AngleAxisf(0.7F, Vector3f(1.0F, 2.0F, -0.5F).normalized()));
  return T;
}

TEST(MeshShapes, BoxHasExactVolume) {
  Mesh mesh;
  add_box(mesh, sample_pose(), {0.5F, 0.2F, 0.1F}, mesh.add({}));
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_NEAR(volume(mesh), 8.0F * 0.5F * 0.2F * 0.1F, 1e-5F);
  expect_normals_outwards(mesh);
}

TEST(MeshShapes, BoxTextureIsInMeters) {
  Mesh mesh;
  add_box(mesh, sample_pose(), {0.5F, 0.2F, 0.1F}, mesh.add({}));
  for (const Triangle& triangle : mesh.triangles) {
    const Vertex& a = mesh.vertices[triangle.corners[0]];
    const Vertex& b = mesh.vertices[triangle.corners[1]];
    EXPECT_NEAR((a.uv - b.uv).norm(), (a.position - b.position).norm(), 1e-5F);
  }
}

TEST(MeshShapes, EllipsoidApproximatesVolume) {
  Mesh mesh;
  add_ellipsoid(mesh, sample_pose(), {0.3F, 0.2F, 0.1F}, mesh.add({}), 48);
  const float exact = 4.0F / 3.0F * kPi * 0.3F * 0.2F * 0.1F;
  EXPECT_NEAR(volume(mesh), exact, 0.01F * exact);
  expect_normals_outwards(mesh);
}

TEST(MeshShapes, CylinderApproximatesVolume) {
  Mesh mesh;
  add_cylinder(mesh, sample_pose(), 0.2F, 0.5F, mesh.add({}), 64);
  const float exact = kPi * 0.2F * 0.2F * 1.0F;
  EXPECT_NEAR(volume(mesh), exact, 0.01F * exact);
  expect_normals_outwards(mesh);
}

TEST(MeshShapes, TruncatedConeApproximatesVolume) {
  Mesh mesh;
  const std::array<Ring, 3> rings = {{{0.0F, 0.3F, 0.3F}, {0.5F, 0.2F, 0.2F}, {1.0F, 0.1F, 0.1F}}};
  add_loft(mesh, sample_pose(), rings, mesh.add({}), 64);
  const float exact = kPi / 3.0F * (0.09F + 0.03F + 0.01F);
  EXPECT_NEAR(volume(mesh), exact, 0.01F * exact);
  expect_normals_outwards(mesh);
}

TEST(MeshShapes, PrismHasExactVolume) {
  Mesh mesh;
  const std::array<Eigen::Vector2f, 4> outline = {
      {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.8F, 0.5F}, {0.0F, 0.5F}}};
  add_prism(mesh, sample_pose(), outline, 0.25F, mesh.add({}));
  EXPECT_NEAR(volume(mesh), 0.45F * 0.5F, 1e-5F);
  expect_normals_outwards(mesh);
}

TEST(Mesh, MirroredShapeStaysClosed) {
  Mesh mesh;
  add_box(mesh, sample_pose(), {0.5F, 0.2F, 0.1F}, mesh.add({}));
  const Eigen::AlignedBox3f before = bounds(mesh, Eigen::Isometry3f::Identity());
  mirror(mesh);
  const Eigen::AlignedBox3f after = bounds(mesh, Eigen::Isometry3f::Identity());
  EXPECT_FLOAT_EQ(after.min().x(), -before.max().x());
  EXPECT_FLOAT_EQ(after.min().y(), before.min().y());
  EXPECT_NEAR(volume(mesh), 8.0F * 0.5F * 0.2F * 0.1F, 1e-5F);
  expect_normals_outwards(mesh);
}

TEST(Mesh, AppendKeepsShapesAndMaterialsApart) {
  Mesh part;
  Material red;
  red.color = {1.0F, 0.0F, 0.0F};
  add_box(part, at(0.0F, 0.0F, 0.0F), {0.5F, 0.5F, 0.5F}, part.add(red));
  Mesh mesh;
  add_box(mesh, at(0.0F, 0.0F, 0.0F), {0.1F, 0.1F, 0.1F}, mesh.add({}));
  append(mesh, part, at(5.0F, 0.0F, 0.0F));
  EXPECT_EQ(mesh.triangles.size(), 24U);
  EXPECT_EQ(mesh.materials[mesh.triangles.back().material].color, red.color);
  EXPECT_NEAR(volume(mesh), 1.008F, 1e-4F);
  const Eigen::AlignedBox3f box = bounds(mesh, Eigen::Isometry3f::Identity());
  EXPECT_NEAR(box.max().x(), 5.5F, 1e-6F);
  EXPECT_NEAR(box.min().x(), -0.1F, 1e-6F);
}

}  // namespace
}  // namespace mms
