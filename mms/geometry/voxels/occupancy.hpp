#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/transform.hpp"
#include "mms/geometry/voxels/voxel_key.hpp"

namespace mms {

/// State of a cell for navigation.
enum class Occupancy : std::uint8_t { kUnknown, kFree, kOccupied };

/// Frame of navigation maps: origin on the floor below the first sensor pose, z up, x along that
/// sensor's forward axis.
struct Map {};

/// Occupied and free voxels; all others are unknown. Keys are sorted and unique.
struct OccupancyVoxels {
  double voxel_size = 0.1;  ///< side [m]
  std::vector<VoxelKey> occupied;
  std::vector<VoxelKey> free;
};

/// Top view of the floor, for navigation.
struct OccupancyGrid {
  double resolution = 0.1;                           ///< side of a cell [m]
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< corner of cell (0, 0) in the map frame [m]
  Image<Occupancy> cells;  ///< columns along the map frame's x, rows along its y
  Transform<World, Map> T_world_map;
};

}  // namespace mms
