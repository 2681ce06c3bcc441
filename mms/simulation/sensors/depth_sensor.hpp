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

/// How a depth camera fails to measure the truth.
struct DepthSensor {
  DepthNoise noise;             ///< of a surface seen straight on
  double grazing_growth = 0.5;  ///< sigma times 1 + growth * (1 / cos - 1) at an angle, at most 4
  double min_range = 0.25;      ///< [m]
  double max_range = 9.0;       ///< [m]
  DepthQuantisation quantisation = DepthQuantisation::kDepth;
  double step = 0.00025;  ///< [m], or the disparity's [1/m]; 0 for none
  double lost_cosine =
      0.12;  ///< surfaces at a smaller cosine give nothing; half of them at twice it
  /// Darker materials give nothing at `max_range`; nearer by the inverse square of the range
  /// (light that returns), and half of those 1.5 times as bright.
  double lost_darkness = 0.03;
  double boundary_lost = 0.4;   ///< share of pixels at boundaries of objects that give nothing
  double boundary_mixed = 0.2;  ///< ... and a depth between both surfaces ("flying pixels")
  int boundary_reach = 2;  ///< pixels this near to a jump of depth are its boundary [px], at most 8
};

/// Depth as the camera measures it [m], 0 for none and else within the sensor's range. Besides what
/// `sensor` says, mirror-like surfaces are lost where they send the light elsewhere: gloss^2 of the
/// pixels whose cosine is below 0.7. `key` makes the frame's noise; the same bits for any number of
/// threads.
Image<float> measured_depth(const ExactView& view, const DepthSensor& sensor, std::uint64_t key);

}  // namespace mms
