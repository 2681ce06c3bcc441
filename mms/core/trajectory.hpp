#pragma once

#include <vector>

#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"

namespace mms {

/// Sensor pose at one instant.
struct StampedPose {
  Timestamp stamp;
  Transform<World, Sensor> T_world_sensor;
};

using Trajectory = std::vector<StampedPose>;

}  // namespace mms
