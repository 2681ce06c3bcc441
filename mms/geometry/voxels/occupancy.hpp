#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/transform.hpp"
#include "mms/geometry/voxels/voxel_key.hpp"

namespace mms {

/// What a robot may expect of a piece of space.
enum class Occupancy : std::uint8_t { kUnknown, kFree, kOccupied };

/// The frame of a robot's maps: origin on the floor below the first sensor pose, z up, x along that
/// sensor's forward axis.
struct Map {};

/// Space cut into cubes; those in neither list are unknown. No key comes twice; both are sorted.
struct OccupancyVoxels {
  double voxel_size = 0.1;  ///< side [m]
  std::vector<VoxelKey> occupied;
  std::vector<VoxelKey> free;
};

/// The floor seen from above, for a robot that drives on it.
struct OccupancyGrid {
  double resolution = 0.1;                           ///< side of a cell [m]
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< corner of cell (0, 0) in the map frame [m]
  Image<Occupancy> cells;                            ///< x along the map frame's x, y along its y
  Transform<World, Map> T_world_map;
};

}  // namespace mms
