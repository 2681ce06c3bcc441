#include "mms/run/results/robot_maps.hpp"

#include <fmt/core.h>

#include <cstdio>

#include "mms/io/results/occupancy_grid_io.hpp"
#include "mms/io/results/octomap_io.hpp"
#include "mms/mapping/ground/floor.hpp"
#include "mms/mapping/ground/floor_map.hpp"

namespace mms {

void write_robot_maps(const std::filesystem::path& folder, const OccupancyMap& occupancy,
                      const MapCloud& map, bool is_depth, MapMarking marking,
                      const std::vector<Eigen::Vector3f>& gone) {
  const OccupancyConfig& config = occupancy.config();
  if (!config.enabled) return;
  const SensorAxes axes = is_depth ? SensorAxes::camera() : SensorAxes::lidar();
  const Floor floor = find_floor(map, axes.up, config.floor);
  if (!floor.found && map.size() > 0) {
    fmt::print(stderr,
               "warning: no floor of {} m^2 found within {} deg of level: map.yaml and map.bt "
               "assume that the first sensor pose is level and that the lowest points are the "
               "floor (see occupancy.floor in the settings)\n",
               config.floor.min_area, config.floor.max_tilt);
  }
  const Transform<World, Map> T_world_map = map_frame(floor, axes.forward);
  OccupancyVoxels voxels = voxels_in_map_frame(occupancy, T_world_map);
  remove_occupied(gone, T_world_map, voxels);
  if (marking == MapMarking::kObstacles) add_occupied(map.points, T_world_map, voxels);
  write_occupancy_grid(folder / "map.yaml", floor_grid(voxels, T_world_map, config.grid));
  const std::size_t left_out = write_octomap(folder / "map.bt", voxels);
  if (left_out > 0) {
    fmt::print(stderr,
               "warning: map.bt lacks {} voxels farther than 32768 voxels of {} m (raise "
               "occupancy.voxel_size)\n",
               left_out, voxels.voxel_size);
  }
}

}  // namespace mms
