#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/simulation/sensors/lidar_sensor.hpp"
#include "mms/simulation/world/stage.hpp"

namespace mms {

/// A scan and what its points really lie on.
struct ExactScan {
  LidarScan scan;
  std::vector<Eigen::Vector3f> points;  ///< exact, in the building's frame [m]
  std::vector<std::int32_t> labels;     ///< 0 static, else 1 + id of the object
};

/// Scan number `index` of a LiDAR that moves: `T_building_lidar(t)` is its pose `t` seconds after
/// the scan's start, which is at `start` [s]. Every point is in the LiDAR's frame at its own time.
/// Leaves the stage as it is at the scan's end.
ExactScan scan(Stage& stage, const LidarSensor& sensor, int index, double period,
               const std::function<Eigen::Isometry3d(double)>& T_building_lidar, double start,
               bool noise, std::uint64_t key);

}  // namespace mms
