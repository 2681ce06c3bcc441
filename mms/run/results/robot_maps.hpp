#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mms/geometry/voxels/occupancy.hpp"
#include "mms/global_map/global_map.hpp"
#include "mms/mapping/occupancy/occupancy_map.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"
#include "mms/pipeline/system_config.hpp"

namespace mms {

/// Points of the static map as obstacles of the navigation maps.
enum class MapMarking { kNone, kObstacles };

/// Navigation maps in the frame of the floor.
struct RobotMaps {
  OccupancyVoxels voxels;
  OccupancyGrid grid;
  std::string warning{};  ///< where no floor was found; else empty
};

/// Makes the navigation maps.
/// @param map      the static map, in which the floor is searched
/// @param is_depth whether the sensor was a depth camera; else a LiDAR
/// @param marking  whether the points of the static map are obstacles, too
/// @param gone     points that are no obstacles any more [m]
RobotMaps make_robot_maps(const OccupancyMap& occupancy, const MapCloud& map, bool is_depth,
                          MapMarking marking = MapMarking::kNone,
                          const std::vector<Eigen::Vector3f>& gone = {});

/// The occupancy of all keyframes of the map, corrected by loops.
/// @param sessions  of the run, at least 1
OccupancyMap map_occupancy(const GlobalMap& map, std::uint32_t sessions,
                           const SystemConfig& config);

/// Writes the navigation maps to `folder`: the 2D occupancy grid map.pgm and map.yaml, and the 3D
/// occupancy map.bt. Warns on stderr if no floor was found. Writes nothing if the occupancy map is
/// disabled. The parameters are those of `make_robot_maps`.
/// @throws FileError with the file that cannot be written.
void write_robot_maps(const std::filesystem::path& folder, const OccupancyMap& occupancy,
                      const MapCloud& map, bool is_depth, MapMarking marking = MapMarking::kNone,
                      const std::vector<Eigen::Vector3f>& gone = {});

}  // namespace mms
