#include "mms/simulation/people/person_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mms {
namespace {

using Shape = Eigen::Matrix<float, 5, 1>;

Shape shape_of(const Ring& ring) {
  Shape shape;
  shape << ring.z, ring.rx, ring.ry, ring.x, ring.y;
  return shape;
}

Ring ring_of(const Shape& s) {
  return {s[0], std::max(s[1], 5e-4F), std::max(s[2], 5e-4F), s[3], s[4]};
}

/// Slope with respect to z at key `i`, from its neighbors.
Shape slope_at(const std::vector<Ring>& keys, std::size_t i) {
  const Ring& below = keys[i == 0 ? 0 : i - 1];
  const Ring& above = keys[std::min(i + 1, keys.size() - 1)];
  return (shape_of(above) - shape_of(below)) / (above.z - below.z);
}

}  // namespace

std::vector<Ring> smooth_rings(const std::vector<Ring>& keys, float step) {
  std::vector<Ring> rings;
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    const float gap = keys[i + 1].z - keys[i].z;
    const int count = std::max(1, static_cast<int>(std::lround(gap / step)));
    const Shape slope = gap * slope_at(keys, i);
    const Shape next_slope = gap * slope_at(keys, i + 1);
    for (int k = 0; k < count; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(count);
      const float s = t * t * (3.0F - 2.0F * t);
      Shape shape = (1.0F - s) * shape_of(keys[i]) + s * shape_of(keys[i + 1]) +
                    t * (1.0F - t) * ((1.0F - t) * slope - t * next_slope);
      shape[0] = keys[i].z + t * gap;
      rings.push_back(ring_of(shape));
    }
  }
  rings.push_back(keys.back());
  return rings;
}

std::vector<Ring> rounded_rings(const std::vector<Ring>& rings, int rows) {
  const auto angle_of = [rows](int row) {
    return 1.48F * static_cast<float>(row) / static_cast<float>(rows);
  };
  const auto cap = [](const Ring& end, float angle, float direction) {
    const float reach = direction * std::sin(angle) * std::min(end.rx, end.ry);
    const float share = std::cos(angle);
    return Ring{end.z + reach, share * end.rx, share * end.ry, end.x, end.y};
  };
  std::vector<Ring> result;
  for (int i = rows; i > 0; --i) result.push_back(cap(rings.front(), angle_of(i), -1.0F));
  result.insert(result.end(), rings.begin(), rings.end());
  for (int i = 1; i <= rows; ++i) result.push_back(cap(rings.back(), angle_of(i), 1.0F));
  return result;
}

std::vector<Ring> scaled_rings(std::vector<Ring> rings, float factor) {
  for (Ring& ring : rings) ring = ring_of(factor * shape_of(ring));
  return rings;
}

void add_painted_loft(Mesh& mesh, const std::vector<Ring>& rings, const Paint& paint,
                      int segments) {
  const std::size_t first = mesh.triangles.size();
  const auto around = static_cast<std::size_t>(segments);
  add_loft(mesh, Eigen::Isometry3f::Identity(), rings, paint(rings.back().z, 0.0F), segments);
  for (std::size_t row = 0; row + 1 < rings.size(); ++row) {
    for (std::size_t i = 0; i < around; ++i) {
      const float angle = 2.0F * std::numbers::pi_v<float> * (static_cast<float>(i) + 0.5F) /
                          static_cast<float>(segments);
      const std::uint32_t material = paint(0.5F * (rings[row].z + rings[row + 1].z), angle);
      const std::size_t patch = first + 2 * (row * around + i);
      mesh.triangles[patch].material = material;
      mesh.triangles[patch + 1].material = material;
    }
  }
}

Eigen::Isometry3f turned(float angle, const Eigen::Vector3f& axis) {
  return Eigen::Isometry3f(Eigen::AngleAxisf(angle, axis));
}

Eigen::Isometry3f lying() {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear().col(0) = Eigen::Vector3f::UnitZ();
  T.linear().col(1) = -Eigen::Vector3f::UnitY();
  T.linear().col(2) = Eigen::Vector3f::UnitX();
  return T;
}

}  // namespace mms
