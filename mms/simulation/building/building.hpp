#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mms/simulation/config/scene_config.hpp"
#include "mms/simulation/models/lights.hpp"
#include "mms/simulation/models/mesh.hpp"

namespace mms {

/// Position of a worker at a rack, facing it.
struct Workplace {
  Eigen::Vector2d position;  ///< [m]
  double yaw;                ///< [rad]
};

/// Static part of a scene, and the free lane. z is up, the floor at 0 [m].
struct Building {
  Mesh mesh;
  Lights lights;
  std::vector<Eigen::Vector2d> lane;  ///< corners of the lane's center line
  bool lane_closed = false;
  double lane_half_width = 1.0;  ///< [m]
  double vehicle_aside = 1.3;    ///< of oncoming vehicles from the center line [m]
  double care = 1e9;  ///< of actors for each other up to this distance from the sensor [m]
  std::vector<Workplace> workplaces;
};

/// Builds the layout of a scene. Deterministic.
Building build(const SceneConfig& config);

}  // namespace mms
