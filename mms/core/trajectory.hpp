#pragma once

#include <vector>

#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"

namespace mms {

/// Sensor pose at one instant.
struct StampedPose {
  Timestamp stamp;                          ///< of the frame
  Transform<World, Sensor> T_world_sensor;  ///< pose of the sensor in the world
};

/// Poses in the order of their stamps.
using Trajectory = std::vector<StampedPose>;

}  // namespace mms
