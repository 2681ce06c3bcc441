#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"

namespace mms {

/// What a colour camera does to light.
struct ColorSensor {
  CameraIntrinsics intrinsics;
  double exposure = 0.008;  ///< [s]; whoever renders the radiances averages over it
  double read_noise = 1.0;  ///< one sigma in the dark [grey levels of 255 in the finished picture]
  double shot_noise = 1.5;  ///< one sigma at full white, growing with the root of the light
  double vignetting =
      0.25;               ///< share of light lost in the corners, growing with the radius squared
  double softness = 0.5;  ///< one sigma of the lens' blur [px]
  int jpeg_quality = 92;  ///< of recordings
};

/// Picture of linear radiances (1 is what becomes white), of any size: lens blur, vignetting about
/// the centre, sRGB curve (IEC 61966-2-1), then noise with
/// sigma^2 = read_noise^2 + shot_noise^2 * light. Radiances that are no numbers are black. `key`
/// makes the frame's noise; the same bits for any number of threads.
Image<Rgb> develop(const Image<Eigen::Vector3f>& radiance, const ColorSensor& sensor,
                   std::uint64_t key);

}  // namespace mms
