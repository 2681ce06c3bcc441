#include "mms/simulation/models/mesh_shapes.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace mms {
namespace {

std::uint32_t add_vertex(Mesh& mesh, const Eigen::Isometry3f& T, const Eigen::Vector3f& position,
                         const Eigen::Vector3f& normal, const Eigen::Vector2f& uv) {
  mesh.vertices.push_back({T * position, T.linear() * normal.normalized(), uv});
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

/// Flat quadrilateral, corners counter-clockwise from outside; uv along its sides.
void add_quad(Mesh& mesh, const Eigen::Isometry3f& T, const std::array<Eigen::Vector3f, 4>& corners,
              const Eigen::Vector2f& uv, std::uint32_t material) {
  const Eigen::Vector3f u = corners[1] - corners[0];
  const Eigen::Vector3f v = corners[3] - corners[0];
  const Eigen::Vector3f normal = u.cross(v);
  const Eigen::Vector2f to_u(u.norm(), 0.0F);
  const Eigen::Vector2f to_v(0.0F, v.norm());
  const std::uint32_t a = add_vertex(mesh, T, corners[0], normal, uv);
  const std::uint32_t b = add_vertex(mesh, T, corners[1], normal, uv + to_u);
  const std::uint32_t c = add_vertex(mesh, T, corners[2], normal, uv + to_u + to_v);
  const std::uint32_t d = add_vertex(mesh, T, corners[3], normal, uv + to_v);
  mesh.triangles.push_back({{a, b, c}, material});
  mesh.triangles.push_back({{a, c, d}, material});
}

/// Flat face with an outline that is star-shaped about `center`.
void add_fan(Mesh& mesh, const Eigen::Isometry3f& T, const std::vector<Eigen::Vector3f>& outline,
             const Eigen::Vector3f& center, const Eigen::Vector3f& normal, std::uint32_t material) {
  const Eigen::Vector3f u = normal.unitOrthogonal();
  const Eigen::Vector3f v = normal.cross(u);
  const auto uv_of = [&](const Eigen::Vector3f& p) { return Eigen::Vector2f(p.dot(u), p.dot(v)); };
  const std::uint32_t hub = add_vertex(mesh, T, center, normal, uv_of(center));
  std::vector<std::uint32_t> boundary;
  for (const Eigen::Vector3f& p : outline)
    boundary.push_back(add_vertex(mesh, T, p, normal, uv_of(p)));
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const std::size_t next = (i + 1) % boundary.size();
    const Eigen::Vector3f turn = (outline[i] - center).cross(outline[next] - center);
    const bool forward = turn.dot(normal) > 0.0F;
    mesh.triangles.push_back(
        {{hub, forward ? boundary[i] : boundary[next], forward ? boundary[next] : boundary[i]},
         material});
  }
}

float angle_of(int segment, int segments) {
  return 2.0F * std::numbers::pi_v<float> * static_cast<float>(segment) /
         static_cast<float>(segments);
}

/// Triangles between adjacent rows of (segments + 1) vertices each, starting at `first`.
void add_skin(Mesh& mesh, std::uint32_t first, int rows, int segments, std::uint32_t material) {
  const auto stride = static_cast<std::uint32_t>(segments + 1);
  for (int row = 0; row + 1 < rows; ++row) {
    for (int i = 0; i < segments; ++i) {
      const std::uint32_t a =
          first + static_cast<std::uint32_t>(row) * stride + static_cast<std::uint32_t>(i);
      mesh.triangles.push_back({{a, a + 1, a + stride + 1}, material});
      mesh.triangles.push_back({{a, a + stride + 1, a + stride}, material});
    }
  }
}

}  // namespace

void add_box(Mesh& mesh, const Eigen::Isometry3f& T, const Eigen::Vector3f& half,
             std::uint32_t material) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      // Vertical faces have u along the horizontal and v upwards.
      Eigen::Vector3f w = Eigen::Vector3f::Unit(axis) * side;
      Eigen::Vector3f v = axis == 2 ? Eigen::Vector3f::UnitY() : Eigen::Vector3f::UnitZ();
      Eigen::Vector3f u = v.cross(w);
      const auto corner = [&](float su, float sv) {
        return Eigen::Vector3f((w + su * u + sv * v).cwiseProduct(half));
      };
      const Eigen::Vector2f uv(3.1F * static_cast<float>(axis) + 1.7F * side, 0.0F);
      add_quad(mesh, T, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, uv, material);
    }
  }
}

void add_ellipsoid(Mesh& mesh, const Eigen::Isometry3f& T, const Eigen::Vector3f& radii,
                   std::uint32_t material, int segments) {
  const int rows = segments / 2 + 1;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int row = 0; row < rows; ++row) {
    const float polar =
        std::numbers::pi_v<float> * (static_cast<float>(row) / static_cast<float>(rows - 1) - 0.5F);
    for (int i = 0; i <= segments; ++i) {
      const float angle = angle_of(i, segments);
      const Eigen::Vector3f unit(std::cos(polar) * std::cos(angle),
                                 std::cos(polar) * std::sin(angle), std::sin(polar));
      const Eigen::Vector2f uv(angle * 0.5F * (radii.x() + radii.y()), polar * radii.z());
      add_vertex(mesh, T, unit.cwiseProduct(radii), unit.cwiseQuotient(radii), uv);
    }
  }
  add_skin(mesh, first, rows, segments, material);
}

void add_loft(Mesh& mesh, const Eigen::Isometry3f& T, std::span<const Ring> rings,
              std::uint32_t material, int segments) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto rows = static_cast<int>(rings.size());
  const auto point = [](const Ring& ring, float angle) {
    return Eigen::Vector3f(ring.x + ring.rx * std::cos(angle), ring.y + ring.ry * std::sin(angle),
                           ring.z);
  };
  for (int row = 0; row < rows; ++row) {
    const Ring& ring = rings[static_cast<std::size_t>(row)];
    const Ring& below = rings[static_cast<std::size_t>(std::max(0, row - 1))];
    const Ring& above = rings[static_cast<std::size_t>(std::min(rows - 1, row + 1))];
    for (int i = 0; i <= segments; ++i) {
      const float angle = angle_of(i, segments);
      const Eigen::Vector3f around(-ring.rx * std::sin(angle), ring.ry * std::cos(angle), 0.0F);
      const Eigen::Vector3f upwards = point(above, angle) - point(below, angle);
      add_vertex(mesh, T, point(ring, angle), around.cross(upwards),
                 {angle * 0.5F * (ring.rx + ring.ry), ring.z});
    }
  }
  add_skin(mesh, first, rows, segments, material);
  for (const bool top : {false, true}) {
    const Ring& ring = top ? rings.back() : rings.front();
    std::vector<Eigen::Vector3f> outline;
    for (int i = 0; i < segments; ++i) outline.push_back(point(ring, angle_of(i, segments)));
    add_fan(mesh, T, outline, {ring.x, ring.y, ring.z},
            Eigen::Vector3f::UnitZ() * (top ? 1.0F : -1.0F), material);
  }
}

void add_cylinder(Mesh& mesh, const Eigen::Isometry3f& T, float radius, float half_length,
                  std::uint32_t material, int segments) {
  const std::array<Ring, 2> rings = {
      {{-half_length, radius, radius}, {half_length, radius, radius}}};
  add_loft(mesh, T, rings, material, segments);
}

void add_prism(Mesh& mesh, const Eigen::Isometry3f& T, std::span<const Eigen::Vector2f> polygon,
               float half_width, std::uint32_t material) {
  Eigen::Vector2f center = Eigen::Vector2f::Zero();
  for (const Eigen::Vector2f& p : polygon) center += p / static_cast<float>(polygon.size());
  const auto lifted = [](const Eigen::Vector2f& p, float y) {
    return Eigen::Vector3f(p.x(), y, p.y());
  };
  float along = 0.0F;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2f& p = polygon[i];
    const Eigen::Vector2f& q = polygon[(i + 1) % polygon.size()];
    add_quad(mesh, T,
             {lifted(p, -half_width), lifted(p, half_width), lifted(q, half_width),
              lifted(q, -half_width)},
             {0.0F, along}, material);
    along += (q - p).norm();
  }
  for (const float side : {-1.0F, 1.0F}) {
    std::vector<Eigen::Vector3f> outline;
    for (const Eigen::Vector2f& p : polygon) outline.push_back(lifted(p, side * half_width));
    add_fan(mesh, T, outline, lifted(center, side * half_width), Eigen::Vector3f::UnitY() * side,
            material);
  }
}

}  // namespace mms
