#pragma once

#include <cstdint>

#include "mms/core/image.hpp"
#include "mms/geometry/depth_noise.hpp"
#include "mms/simulation/sensors/exact_view.hpp"

namespace mms {

enum class DepthQuantisation : std::uint8_t {
  kDepth,      ///< equal steps of depth (time of flight)
  kDisparity,  ///< equal steps of disparity (stereo, structured light)
};

/// Error model of a depth camera.
struct DepthSensor {
  DepthNoise noise;  ///< for a perpendicular surface
  double grazing_growth =
      0.5;                  ///< factor of sigma 1 + growth * (1 / cos - 1) at an angle, at most 4
  double min_range = 0.25;  ///< [m]
  double max_range = 9.0;   ///< [m]
  DepthQuantisation quantisation = DepthQuantisation::kDepth;
  double step = 0.00025;      ///< [m], or of the disparity [1/m]; 0 for none
  double lost_cosine = 0.12;  ///< no return at a smaller cosine; 50 % at twice this value
  /// Reflectance below which a surface at `max_range` has no return; nearer it scales with the
  /// squared range. Surfaces 1.5 times as bright have 50 % returns.
  double lost_darkness = 0.03;
  double boundary_lost = 0.4;  ///< share of pixels at object boundaries without return
  double boundary_mixed =
      0.2;  ///< share of these pixels with a depth between both surfaces ("flying pixels")
  int boundary_reach =
      2;  ///< distance from a depth jump up to which a pixel is at the boundary [px], at most 8
};

/// Measured depth [m], within the sensor's range, 0 for no return. In addition to the settings of
/// `sensor`, specular surfaces have no return at an angle: gloss^2 of the pixels whose cosine is
/// below 0.7. `key` determines the noise; bitwise equal for any number of threads.
Image<float> measured_depth(const ExactView& view, const DepthSensor& sensor, std::uint64_t key);

}  // namespace mms
