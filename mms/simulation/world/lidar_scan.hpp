#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/simulation/sensors/lidar_sensor.hpp"
#include "mms/simulation/world/stage.hpp"

namespace mms {

/// A scan with exact points and labels.
struct ExactScan {
  LidarScan scan;
  std::vector<Eigen::Vector3f> points;  ///< exact, in the building's frame [m]
  std::vector<std::int32_t> labels;     ///< 0 static, else 1 + id of the object
};

/// Scan number `index` of a moving LiDAR: `T_building_lidar(t)` is its pose `t` seconds after the
/// scan's start at `start` [s]. Every point is in the LiDAR frame at its own time. Leaves the stage
/// at the end of the scan.
ExactScan scan(Stage& stage, const LidarSensor& sensor, int index, double period,
               const std::function<Eigen::Isometry3d(double)>& T_building_lidar, double start,
               bool noise, std::uint64_t key);

}  // namespace mms
