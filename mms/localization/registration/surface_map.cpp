#include "mms/localization/registration/surface_map.hpp"

#include <cmath>
#include <limits>

namespace mms {
namespace {

/// [-]: least cosine between normals of one surface, 45 degrees.
/// Source: the bisector of a right-angled corner.
constexpr float kMinNormalCosine = 0.7F;

}  // namespace

void SurfaceMap::insert(const std::vector<PlaneFeature>& planes,
                        const Eigen::Isometry3d& T_world_sensor) {
  const Eigen::Isometry3f T = T_world_sensor.cast<float>();
  for (const PlaneFeature& plane : planes) {
    const Eigen::Vector3f point = T * plane.point;
    const Eigen::Vector3f normal = T.linear() * plane.normal;
    const float weight = 1.0F / (plane.sigma * plane.sigma);
    Cell& cell = voxels_.touch(voxels_.key(point));
    // On the other side of a thin board, or of a corner, a mean of both would be on neither.
    const bool other_surface = cell.normal.dot(normal) < kMinNormalCosine * cell.normal.norm();
    if (cell.weight > 0.0F && other_surface) continue;
    cell.weight += weight;
    cell.mean += (point - cell.mean) * (weight / cell.weight);
    cell.normal += weight * normal;
  }
  voxels_.enforce_bound();
}

void SurfaceMap::insert(const SurfaceMap& other) {
  for (const auto& entry : other.voxels_.entries()) {
    const Cell& surface = entry.cell;
    Cell& cell = voxels_.touch(voxels_.key(surface.mean));
    const bool other_surface = cell.normal.dot(surface.normal) <
                               kMinNormalCosine * cell.normal.norm() * surface.normal.norm();
    if (cell.weight > 0.0F && other_surface) continue;
    cell.weight += surface.weight;
    cell.mean += (surface.mean - cell.mean) * (surface.weight / cell.weight);
    cell.normal += surface.normal;
  }
  voxels_.enforce_bound();
}

std::optional<SurfaceMap::Surface> SurfaceMap::match(const Eigen::Vector3f& point,
                                                     const Eigen::Vector3f& normal) const {
  const VoxelKey centre = voxels_.key(point);
  const Cell* best = nullptr;
  float best_distance2 = std::numeric_limits<float>::max();
  const VoxelKey low{centre.x - 1, centre.y - 1, centre.z - 1};
  const VoxelKey high{centre.x + 1, centre.y + 1, centre.z + 1};
  voxels_.for_each_in(low, high, [&](const Cell& cell) {
    const float distance2 = (cell.mean - point).squaredNorm();
    if (distance2 >= best_distance2) return;
    if (cell.normal.dot(normal) < kMinNormalCosine * cell.normal.norm()) return;
    best = &cell;
    best_distance2 = distance2;
  });
  if (best == nullptr) return std::nullopt;
  return Surface{best->mean, best->normal.normalized(), 1.0F / std::sqrt(best->weight)};
}

}  // namespace mms
