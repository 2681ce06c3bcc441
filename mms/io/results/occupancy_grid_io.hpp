#pragma once

#include <filesystem>

#include "mms/geometry/voxels/occupancy.hpp"

namespace mms {

/// Writes a grid for ROS map servers (map_server, nav2): the image NAME.pgm next to `yaml`, an
/// 8-bit PGM with the largest y on top, 254 for free, 0 for occupied, 205 for unknown; and
/// NAME.yaml with resolution and origin, in mode trinary. Its key `T_world_map`, which map servers
/// ignore, is the transform from the map frame to the frame of the trajectory. An empty grid
/// becomes one unknown cell, because map servers reject empty images.
/// @param yaml  path of the YAML file
/// @throws FileError if a file cannot be written.
void write_occupancy_grid(const std::filesystem::path& yaml, const OccupancyGrid& grid);

/// Reads `T_world_map` of a grid.
/// @throws FileError if the file cannot be read; ConfigError if it has no such transform.
Transform<World, Map> read_map_frame(const std::filesystem::path& yaml);

}  // namespace mms
