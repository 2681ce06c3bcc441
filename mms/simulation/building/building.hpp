#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mms/simulation/config/scene_config.hpp"
#include "mms/simulation/models/lights.hpp"
#include "mms/simulation/models/mesh.hpp"

namespace mms {

/// A place at a rack where someone can work, facing it.
struct Workplace {
  Eigen::Vector2d position;  ///< [m]
  double yaw;                ///< [rad]
};

/// Everything that stands still, and where there is room to move. z is up, the floor at 0 [m].
struct Building {
  Mesh mesh;
  Lights lights;
  std::vector<Eigen::Vector2d> lane;  ///< corners of the center of the lane that is driven on
  bool lane_closed = false;
  double lane_half_width = 1.0;  ///< [m]
  std::vector<Workplace> workplaces;
};

/// Builds the layout of a scene. The same config gives the same building.
Building build(const SceneConfig& config);

}  // namespace mms
