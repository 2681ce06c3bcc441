#pragma once

#include <Eigen/Core>

#include "mms/core/transform.hpp"
#include "mms/geometry/voxels/occupancy.hpp"
#include "mms/mapping/occupancy/occupancy_config.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"

namespace mms {

/// Directions of up and forward in the frame of a level sensor.
struct SensorAxes {
  Eigen::Vector3d up;
  Eigen::Vector3d forward;

  static SensorAxes camera() { return {-Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()}; }
  static SensorAxes lidar() { return {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()}; }
};

/// The plane that robots drive on: up . p = height.
struct Floor {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit, world frame
  double height = 0.0;                            ///< over the world frame's origin [m]
  bool found = false;                             ///< else assumed: level, at the lowest points
};

/// The lowest level surface of a static map with enough area. Needs no normals of the map's points,
/// so that sparse LiDAR maps are sufficient; where known, they exclude ceilings.
/// @param up  assumed direction of up, world frame; the floor is within `max_tilt` of it
Floor find_floor(const MapCloud& map, const Eigen::Vector3d& up, const FloorConfig& config);

/// The map frame of a floor: x is `forward` (world frame) projected onto the floor.
Transform<World, Map> map_frame(const Floor& floor, const Eigen::Vector3d& forward);

}  // namespace mms
