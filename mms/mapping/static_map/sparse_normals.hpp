#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mms/mapping/static_map/map_cloud.hpp"

namespace mms {

/// A point of a map without a normal.
struct SparsePoint {
  std::size_t index = 0;      ///< in the map
  Eigen::Vector3f viewpoint;  ///< from which it was measured, world frame [m]
};

/// Sets the normals of points that are too far from each other for `neighbourhood_normal`, as those
/// of a LiDAR, whose rings are decimeters apart: of the plane through the nearest 24 points of the
/// map within 0.1 m, or else 0.3 or 1 m. Where these are no plane, the normal is the direction to
/// the viewpoint.
void fill_sparse_normals(MapCloud& map, const std::vector<SparsePoint>& points);

}  // namespace mms
