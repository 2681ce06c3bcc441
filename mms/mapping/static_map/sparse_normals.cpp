#include "mms/mapping/static_map/sparse_normals.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mms/geometry/principal_axes.hpp"
#include "mms/geometry/voxels/cell_chains.hpp"

namespace mms {
namespace {

/// [m]: neighbourhoods that are tried. Source: rings of a LiDAR with 64 lasers are 0.1 m apart at
/// 15 m, on the ground up to 1 m.
constexpr float kRadii[] = {0.1F, 0.3F, 1.0F};

/// [-]: neighbours of a plane. Source: fewer may be of one ring, or of two surfaces by chance.
constexpr std::size_t kMinNearest = 6;
/// [-]: more are farther than needed. Source: a few rings with as many points each.
constexpr std::size_t kMaxNearest = 24;

/// [-]: least second largest variance, relative to the largest. Source: below it the points are a
/// line, as of one LiDAR ring.
constexpr float kMinWidth = 0.02F;
/// [-]: largest variance across the plane, relative to the second largest. Source: as of
/// `neighbourhood_normals`.
constexpr float kMaxFlat = 0.2F;

using Neighbor = std::pair<float, std::size_t>;  // squared distance [m^2], index

/// Normal of the plane through the nearest neighbours; zero for none.
Eigen::Vector3f plane_normal(const MapCloud& map, std::vector<Neighbor>& neighbors) {
  if (neighbors.size() < kMinNearest) return Eigen::Vector3f::Zero();
  if (neighbors.size() > kMaxNearest) {
    const auto end = neighbors.begin() + kMaxNearest;
    std::nth_element(neighbors.begin(), end, neighbors.end());
    neighbors.erase(end, neighbors.end());
  }
  std::vector<Eigen::Vector3f> points;
  points.reserve(neighbors.size());
  for (const auto& [distance, i] : neighbors) points.push_back(map.points[i]);
  const auto axes = principal_axes(scatter_of(points).matrix);
  const Eigen::Vector3f& values = axes.variances;
  const bool flat = values(1) >= kMinWidth * values(2) && values(0) <= kMaxFlat * values(1);
  return flat ? axes.smallest() : Eigen::Vector3f(Eigen::Vector3f::Zero());
}

}  // namespace

void fill_sparse_normals(MapCloud& map, const std::vector<SparsePoint>& points) {
  std::vector<SparsePoint> left = points;
  std::vector<Neighbor> neighbors;
  for (const float radius : kRadii) {
    CellChains cells(map.size(), radius);
    for (std::size_t i = 0; i < map.size(); ++i) cells.insert(map.points[i], i);
    std::erase_if(left, [&](const SparsePoint& sparse) {
      const Eigen::Vector3f& point = map.points[sparse.index];
      neighbors.clear();
      cells.for_each_near(point, [&](std::size_t i) {
        const float distance = (map.points[i] - point).squaredNorm();
        if (distance <= radius * radius) neighbors.emplace_back(distance, i);
      });
      // Farther points would not be among the nearest.
      const bool last = radius == std::end(kRadii)[-1] || neighbors.size() >= kMaxNearest;
      const Eigen::Vector3f normal = plane_normal(map, neighbors);
      const Eigen::Vector3f to_viewpoint = sparse.viewpoint - point;
      if (normal.isZero(0.0F)) {
        if (last) map.normals[sparse.index] = to_viewpoint.normalized();
        return last;
      }
      map.normals[sparse.index] = oriented(normal, to_viewpoint);
      return true;
    });
  }
}

}  // namespace mms
