#pragma once

#include "mms/geometry/depth_noise.hpp"

namespace mms {

/// Measurement noise of the sensors, the same for all modules.
struct SensorNoise {
  DepthNoise depth;     ///< of the depth camera
  double range = 0.02;  ///< one sigma of a LiDAR range [m]
};

}  // namespace mms
