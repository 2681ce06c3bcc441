#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace mms {

enum class Pattern : std::uint8_t {
  kPlain,    ///< one colour with faint stains
  kPlaster,  ///< a wall: stains of several sizes
  kPlanks,   ///< a floor of boards
  kTiles,    ///< square panels with dark joints
  kPoster,   ///< random coloured blocks with a white rim
  kStripes,  ///< two colours in turn along u
};

/// What a surface looks like, as a function of the place on it.
struct Material {
  Pattern pattern = Pattern::kPlain;
  Eigen::Vector3f color{0.5F, 0.5F, 0.5F};   ///< red, green, blue in [0, 1]
  float scale = 0.1F;                        ///< size of the pattern's elements [m]
  Eigen::Vector3f second{0.3F, 0.3F, 0.3F};  ///< of patterns with two
  std::uint32_t seed = 1;
};

/// Colour at the surface coordinates (u, v) [m], each channel about [0, 1]. Detail smaller than
/// `footprint` [m], the size of the pixel there, fades out, so that it does not flicker.
Eigen::Vector3f albedo(const Material& material, float u, float v, float footprint);

}  // namespace mms
