#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "mms/mapping/occupancy/occupancy_map.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"

namespace mms {

/// Points of the static map as obstacles of the navigation maps.
enum class MapMarking { kNone, kObstacles };

/// Writes the navigation maps to `folder`: the 2D occupancy grid map.pgm and map.yaml, and the 3D
/// occupancy map.bt, in the frame of the floor. Warns on stderr if no floor was found. Writes
/// nothing if the occupancy map is disabled.
/// @param map      the static map, in which the floor is searched
/// @param is_depth whether the sensor was a depth camera; else a LiDAR
/// @param marking  whether the points of the static map are obstacles, too
/// @param gone     points that are no obstacles any more [m]
/// @throws FileError with the file that cannot be written.
void write_robot_maps(const std::filesystem::path& folder, const OccupancyMap& occupancy,
                      const MapCloud& map, bool is_depth, MapMarking marking = MapMarking::kNone,
                      const std::vector<Eigen::Vector3f>& gone = {});

}  // namespace mms
