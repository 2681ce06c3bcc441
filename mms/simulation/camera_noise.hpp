#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/simulation/ray_caster.hpp"

namespace mms {

/// Depth as a structured-light camera measures it [m]: noise sigma(z) = 0.0012 + 0.0019 (z - 0.4)^2
/// (Nguyen et al., 3DIMPVT 2012), nothing below 0.4 m, beyond `max_depth` [m] and at grazing
/// angles, and at the rims of objects nothing or a mixture of both surfaces. `key` makes the
/// frame's noise.
Image<float> measured_depth(const CastImage& cast, const std::vector<Solid>& solids,
                            const CameraIntrinsics& camera, const Eigen::Isometry3d& T_room_camera,
                            double max_depth, std::uint64_t key);

/// Adds noise of `sigma` grey levels to every channel.
void add_color_noise(Image<Rgb>& image, double sigma, std::uint64_t key);

}  // namespace mms
