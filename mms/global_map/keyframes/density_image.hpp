#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "mms/core/image.hpp"

namespace mms {

/// [m]: side of a pixel of density images. Source: the patch of ORB then covers 3 m, about what
/// makes a place unlike others, and the noise of a LiDAR stays below a pixel.
inline constexpr double kDensityPixel = 0.1;

/// A map seen from above: how much of the height over each place of the floor is occupied (as
/// MapClosures: Gupta et al., ICRA 2024).
struct DensityImage {
  Image<std::uint8_t> share;                         ///< 0 for empty, 255 for occupied
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< of pixel (0, 0) [m]

  /// Place on the floor of a position in the image [px], whose pixels have integers as centers [m].
  Eigen::Vector2d place_of(const Eigen::Vector2d& pixel) const {
    return corner + kDensityPixel * (pixel.array() + 0.5).matrix();
  }
};

/// The image of points above the floor. Voxels count, not points, so that the number of points on a
/// surface has no effect. Empty without such points.
/// @param points  z is up, the floor at 0 [m]
DensityImage make_density_image(std::span<const Eigen::Vector3f> points);

}  // namespace mms
