#pragma once

#include "mms/core/image.hpp"
#include "mms/geometry/depth_noise.hpp"

namespace mms {

/// Noise of a depth image over the assumed one, from the bends of its rows: a plane has none in
/// inverse depth. Quantized or smoothed depth has less. 0 if the image has too little depth.
/// @param depth  [m]; 0, NaN and infinity: no return
double noise_ratio(const Image<float>& depth, const DepthNoise& assumed);

/// The assumed noise, raised to that of a depth image if that is larger.
DepthNoise measured_noise(const DepthNoise& assumed, const Image<float>& depth);

}  // namespace mms
