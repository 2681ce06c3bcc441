#pragma once

#include "mms/core/calibration.hpp"

namespace mms {

/// The camera whose images are those of `camera` scaled to another size. Pixel centers have whole
/// coordinates, so the corner of an image is at -0.5.
inline CameraIntrinsics resized_camera(const CameraIntrinsics& camera, int width, int height) {
  const double sx = static_cast<double>(width) / camera.width;
  const double sy = static_cast<double>(height) / camera.height;
  return {sx * camera.fx,
          sy * camera.fy,
          (camera.cx + 0.5) * sx - 0.5,
          (camera.cy + 0.5) * sy - 0.5,
          width,
          height,
          camera.distortion};
}

}  // namespace mms
