#pragma once

#include <filesystem>

#include "mms/geometry/voxels/occupancy.hpp"

namespace mms {

/// Writes a grid as ROS map servers read it (map_server, nav2): the picture NAME.pgm beside
/// `yaml`, an 8-bit PGM with the largest y on top, 254 for free, 0 for occupied, 205 for unknown;
/// and NAME.yaml with its resolution and origin, in mode trinary. The key `T_world_map` in it,
/// which map servers ignore, takes the map frame to the frame of the trajectory. An empty grid is
/// one unknown cell, because map servers refuse empty pictures.
/// @param yaml  path of the YAML file
/// @throws FileError when a file cannot be written.
void write_occupancy_grid(const std::filesystem::path& yaml, const OccupancyGrid& grid);

}  // namespace mms
