#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/core/transform.hpp"
#include "mms/geometry/voxels/occupancy.hpp"
#include "mms/mapping/occupancy/occupancy_map.hpp"

namespace mms {

/// The occupancy map resampled to voxels along the axes of the map frame: each has the state of the
/// voxel that its centre lies in, so that closed surfaces stay closed. Sorted by key.
OccupancyVoxels voxels_in_map_frame(const OccupancyMap& map,
                                    const Transform<World, Map>& T_world_map);

/// Marks the voxels of points as occupied.
/// @param points  world frame [m]; those that are not finite or too far are left out
void add_occupied(const std::vector<Eigen::Vector3f>& points,
                  const Transform<World, Map>& T_world_map, OccupancyVoxels& voxels);

/// Marks the occupied voxels of points as free.
void remove_occupied(const std::vector<Eigen::Vector3f>& points,
                     const Transform<World, Map>& T_world_map, OccupancyVoxels& voxels);

/// The 2D grid of the floor. A cell is occupied if any voxel between `min_height` and `max_height`
/// above it is, isolated voxels excepted; else free if the floor, or empty space below
/// `free_height`, was seen; else unknown. Empty if nothing is known. Very large maps get cells of
/// several voxels.
/// @param voxels  in the map frame, sorted
OccupancyGrid floor_grid(const OccupancyVoxels& voxels, const Transform<World, Map>& T_world_map,
                         const GridConfig& config);

}  // namespace mms
