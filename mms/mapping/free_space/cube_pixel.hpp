#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "mms/core/image.hpp"

namespace mms {

/// One image for each side of a cube around a LiDAR: values by direction, for any mounting and scan
/// pattern.
template <class T>
using CubeImage = std::array<Image<T>, 6>;

template <class T>
CubeImage<T> make_cube(int side) {
  CubeImage<T> cube;
  cube.fill(Image<T>(side, side));
  return cube;
}

/// Whether a point at `range` [m] has a direction and a position.
inline bool has_direction(float range) {
  return range > 0.0F && std::isfinite(range);
}

/// The pixel of a finite direction, in a cube of side x side pixels a face of 90 degrees; any pixel
/// for the zero vector.
struct CubePixel {
  std::size_t face = 0;
  int x = 0;
  int y = 0;

  CubePixel(const Eigen::Vector3f& direction, int side) {
    Eigen::Index axis = 0;
    const float longest = direction.cwiseAbs().maxCoeff(&axis);
    const float along = std::max(longest, std::numeric_limits<float>::min());
    const auto place = [&](float across) {
      const float pixel = (across / along + 1.0F) * (0.5F * static_cast<float>(side));
      return std::clamp(static_cast<int>(pixel), 0, side - 1);
    };
    face = static_cast<std::size_t>(2 * axis + (direction(axis) < 0.0F ? 1 : 0));
    x = place(direction((axis + 1) % 3));
    y = place(direction((axis + 2) % 3));
  }
};

}  // namespace mms
