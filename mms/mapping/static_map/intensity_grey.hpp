#pragma once

#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// [-]: color of points without camera and intensity. Source: half of 8 bits.
inline constexpr Rgb kNoColor{128, 128, 128};

/// Grey for the intensity of a LiDAR's point. Most surfaces reflect little: the root spreads these,
/// and the darkest ones are still seen before a dark background.
/// @param intensity  [0, 255]
Rgb grey_of(std::uint8_t intensity);

/// The intensities [0, 1] of which the colors of a map are greys; empty if they are colors of a
/// camera, or if the points have no intensities. Means of greys give means of the roots.
std::vector<float> intensities_of(const std::vector<Rgb>& greys);

}  // namespace mms
