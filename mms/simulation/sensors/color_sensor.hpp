#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"

namespace mms {

/// Model of a color camera.
struct ColorSensor {
  CameraIntrinsics intrinsics;
  double exposure = 0.008;  ///< [s]; the renderer averages the radiances over it
  double read_noise =
      1.0;  ///< standard deviation in the dark [gray levels of 255 in the final image]
  double shot_noise =
      1.5;  ///< standard deviation at full white, proportional to the root of the light
  double vignetting =
      0.25;  ///< share of light lost in the corners, proportional to the squared radius
  double softness = 0.5;  ///< standard deviation of the lens blur [px]
  int jpeg_quality = 92;  ///< of recordings
};

/// Image from linear radiances (1 becomes white) of any size: lens blur, vignetting about the
/// center, sRGB curve (IEC 61966-2-1), then noise with sigma^2 = read_noise^2 + shot_noise^2 *
/// light. NaN radiances are black. `key` determines the noise; bitwise equal for any number of
/// threads.
Image<Rgb> develop(const Image<Eigen::Vector3f>& radiance, const ColorSensor& sensor,
                   std::uint64_t key);

}  // namespace mms
