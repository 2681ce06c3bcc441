#include "mms/geometry/normals.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>

#include "mms/geometry/principal_axes.hpp"
#include "mms/geometry/voxels/cell_chains.hpp"

namespace mms {
namespace {

constexpr int kMinNeighbours = 6;
/// Largest ratio of the smallest to the second largest variance of a flat neighborhood.
constexpr float kMaxFlatRatio = 0.2F;

/// Normal of the surface through `points`; zero if they are too few or not flat.
Eigen::Vector3f flat_normal(const std::vector<Eigen::Vector3f>& points) {
  if (points.size() < kMinNeighbours) return Eigen::Vector3f::Zero();
  const auto scatter = scatter_of(points);
  const auto axes = principal_axes(scatter.matrix, EigenMethod::kClosedForm);
  if (!(axes.variances[0] <= kMaxFlatRatio * axes.variances[1])) return Eigen::Vector3f::Zero();
  const Eigen::Vector3f to_origin = -scatter.mean;
  return oriented(axes.smallest(), to_origin);
}

}  // namespace

std::vector<SurfacePatch> grid_patches(std::span<const Eigen::Vector3f> points, int width, int step,
                                       float max_edge) {
  std::vector<SurfacePatch> patches(points.size());
  const int height = width > 0 ? static_cast<int>(points.size()) / width : 0;
  const auto at = [&](int x, int y) { return points[static_cast<std::size_t>(y * width + x)]; };
  // Inverse depth is linear on a plane at any incidence; NaN is connected to nothing.
  const auto is_joined = [&](float before, float z, float after) {
    return std::abs(2.0F / z - 1.0F / before - 1.0F / after) * z * z <= max_edge;
  };
  const float cells = static_cast<float>(4 * step * step);
  for (int y = step; y < height - step; ++y) {
    for (int x = step; x < width - step; ++x) {
      const Eigen::Vector3f right = at(x + step, y), left = at(x - step, y);
      const Eigen::Vector3f below = at(x, y + step), above = at(x, y - step);
      const Eigen::Vector3f point = at(x, y);
      if (!is_joined(left.z(), point.z(), right.z())) continue;
      if (!is_joined(above.z(), point.z(), below.z())) continue;
      const Eigen::Vector3f cross = (right - left).cross(below - above);
      const float norm = cross.norm();
      if (!(norm > 0.0F)) continue;
      const float sign = cross.dot(point) > 0.0F ? -1.0F : 1.0F;
      patches[static_cast<std::size_t>(y * width + x)] = {cross * (sign / norm), norm / cells};
    }
  }
  return patches;
}

std::vector<Eigen::Vector3f> neighbourhood_normals(std::span<const Eigen::Vector3f> points,
                                                   std::size_t stride, float radius) {
  CellChains cells(points.size(), radius);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) cells.insert(points[i], i);
  }
  std::vector<Eigen::Vector3f> normals(points.size(), Eigen::Vector3f::Zero());
  std::vector<Eigen::Vector3f> near;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    if (!points[i].allFinite()) continue;
    near.clear();
    cells.for_each_near(points[i], [&](std::size_t j) {
      if ((points[j] - points[i]).squaredNorm() <= radius * radius) near.push_back(points[j]);
    });
    normals[i] = flat_normal(near);
  }
  return normals;
}

}  // namespace mms
