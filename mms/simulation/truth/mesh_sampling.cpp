#include "mms/simulation/truth/mesh_sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mms {
namespace {

Rgb color_of(const Material& material, const Eigen::Vector2f& uv, float footprint) {
  const Eigen::Vector3f color =
      255.0F * albedo(material, uv.x(), uv.y(), footprint).cwiseMax(0.0F).cwiseMin(1.0F);
  return {static_cast<std::uint8_t>(color.x()), static_cast<std::uint8_t>(color.y()),
          static_cast<std::uint8_t>(color.z())};
}

/// The corner with the largest angle first, so that its sides span a grid.
std::array<const Vertex*, 3> widest_first(const Mesh& mesh, const Triangle& triangle) {
  std::array<const Vertex*, 3> corners{};
  for (std::size_t i = 0; i < 3; ++i) corners[i] = &mesh.vertices[triangle.corners[i]];
  const auto opposite = [&](std::size_t i) {
    return (corners[(i + 1) % 3]->position - corners[(i + 2) % 3]->position).squaredNorm();
  };
  std::size_t widest = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (opposite(i) > opposite(widest)) widest = i;
  }
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(widest),
              corners.end());
  return corners;
}

/// Adds the centers of grid cells of at most spacing x spacing along two sides.
void sample_triangle(const Mesh& mesh, const Triangle& triangle, float spacing, TruthCloud& cloud) {
  const auto [a, b, c] = widest_first(mesh, triangle);
  const Eigen::Vector3f ab = b->position - a->position;
  const Eigen::Vector3f ac = c->position - a->position;
  const Eigen::Vector3f normal = ab.cross(ac).normalized();
  const auto cells = [&](const Eigen::Vector3f& side) {
    return std::max(1, static_cast<int>(std::ceil(side.norm() / spacing)));
  };
  const int rows = cells(ab);
  const int columns = cells(ac);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const float u = (static_cast<float>(i) + 0.5F) / static_cast<float>(rows);
      const float v = (static_cast<float>(j) + 0.5F) / static_cast<float>(columns);
      if (u + v > 1.0F) break;
      const Eigen::Vector2f uv = (1.0F - u - v) * a->uv + u * b->uv + v * c->uv;
      cloud.points.push_back(a->position + u * ab + v * ac);
      cloud.normals.push_back(normal);
      cloud.colors.push_back(color_of(mesh.materials[triangle.material], uv, spacing));
      cloud.labels.push_back(0);
    }
  }
}

}  // namespace

TruthCloud sample(const Mesh& mesh, const Eigen::Isometry3d& T, double spacing) {
  TruthCloud cloud;
  for (const Triangle& triangle : mesh.triangles) {
    sample_triangle(mesh, triangle, static_cast<float>(spacing), cloud);
  }
  const Eigen::Isometry3f to_world = T.cast<float>();
  for (Eigen::Vector3f& point : cloud.points) point = to_world * point;
  for (Eigen::Vector3f& normal : cloud.normals) normal = to_world.linear() * normal;
  return cloud;
}

}  // namespace mms
