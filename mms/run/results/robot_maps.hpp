#pragma once

#include <filesystem>

#include "mms/mapping/occupancy/occupancy_map.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"

namespace mms {

/// Writes the maps that robots drive by into `folder`: the 2D occupancy grid map.pgm and map.yaml,
/// and the 3D occupancy map.bt, both in the floor's frame. Says on stderr where no floor was found.
/// Nothing is written where the occupancy map is not enabled.
/// @param map      the static map, in which the floor is looked for
/// @param is_depth whether the sensor was a depth camera; else a LiDAR
/// @throws FileError naming the file that cannot be written.
void write_robot_maps(const std::filesystem::path& folder, const OccupancyMap& occupancy,
                      const MapCloud& map, bool is_depth);

}  // namespace mms
