#include "mms/run/results/robot_maps.hpp"

#include <fmt/core.h>

#include <cstdio>

#include "mms/global_map/corrected_occupancy.hpp"
#include "mms/io/results/occupancy_grid_io.hpp"
#include "mms/io/results/octomap_io.hpp"
#include "mms/mapping/ground/floor.hpp"
#include "mms/mapping/ground/floor_map.hpp"
#include "mms/pipeline/session_places.hpp"

namespace mms {

RobotMaps make_robot_maps(const OccupancyMap& occupancy, const MapCloud& map, bool is_depth,
                          MapMarking marking, const std::vector<Eigen::Vector3f>& gone) {
  const OccupancyConfig& config = occupancy.config();
  RobotMaps maps;
  const SensorAxes axes = is_depth ? SensorAxes::camera() : SensorAxes::lidar();
  const Floor floor = find_floor(map, axes.up, config.floor);
  if (!floor.found && map.size() > 0) {
    maps.warning = fmt::format(
        "no floor of {} m^2 found within {} deg of level: the navigation maps assume that the "
        "first sensor pose is level and that the lowest points are the floor (see occupancy.floor "
        "in the settings)",
        config.floor.min_area, config.floor.max_tilt);
  }
  const Transform<World, Map> T_world_map = map_frame(floor, axes.forward);
  maps.voxels = voxels_in_map_frame(occupancy, T_world_map);
  remove_occupied(gone, T_world_map, maps.voxels);
  if (marking == MapMarking::kObstacles) add_occupied(map.points, T_world_map, maps.voxels);
  maps.grid = floor_grid(maps.voxels, T_world_map, config.grid);
  return maps;
}

OccupancyMap map_occupancy(const GlobalMap& map, std::uint32_t sessions,
                           const SystemConfig& config) {
  const auto frame = session_of_map_frame(map, sessions);
  const auto shares_frame = [&](std::uint32_t session) {
    return frame && map.share_frame(session, *frame);
  };
  return corrected_occupancy(map.records(), map.poses(), shares_frame, config.occupancy,
                             with_noise(config.static_map.surface, config.noise));
}

void write_robot_maps(const std::filesystem::path& folder, const OccupancyMap& occupancy,
                      const MapCloud& map, bool is_depth, MapMarking marking,
                      const std::vector<Eigen::Vector3f>& gone) {
  if (!occupancy.config().enabled) return;
  const RobotMaps maps = make_robot_maps(occupancy, map, is_depth, marking, gone);
  if (!maps.warning.empty()) fmt::print(stderr, "warning: {}\n", maps.warning);
  write_occupancy_grid(folder / "map.yaml", maps.grid);
  const std::size_t left_out = write_octomap(folder / "map.bt", maps.voxels);
  if (left_out > 0) {
    fmt::print(stderr,
               "warning: map.bt lacks {} voxels farther than 32768 voxels of {} m (raise "
               "occupancy.voxel_size)\n",
               left_out, maps.voxels.voxel_size);
  }
}

}  // namespace mms
