#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace mms {

enum class Pattern : std::uint8_t {
  kPlain,      ///< one color with faint stains
  kPlaster,    ///< a wall: stains of several sizes
  kPlanks,     ///< a floor of boards
  kTiles,      ///< square panels with dark joints
  kPoster,     ///< random colored blocks with a white boundary
  kHazard,     ///< diagonal stripes of two colors
  kConcrete,   ///< slabs with stains, cracks and tire marks
  kCardboard,  ///< brown board with tape, prints of the second color and a white label
  kBrushed,    ///< metal with fine streaks along u
  kCloth,      ///< a garment: faint weave and folds
  kPallet,     ///< boards with open joints
};

/// Color of a surface as a function of the position on it.
struct Material {
  Pattern pattern = Pattern::kPlain;
  Eigen::Vector3f color{0.5F, 0.5F, 0.5F};   ///< red, green, blue in [0, 1]
  float scale = 0.1F;                        ///< size of the pattern's elements [m]
  Eigen::Vector3f second{0.3F, 0.3F, 0.3F};  ///< second color of patterns with two
  std::uint32_t seed = 1;
  float gloss = 0.0F;  ///< specular share of the light, in [0, 1]
};

/// A material with a pattern of one color.
inline Material one_colored(Pattern pattern, const Eigen::Vector3f& color, float scale,
                            std::uint32_t seed, float gloss = 0.0F) {
  Material material;
  material.pattern = pattern;
  material.color = color;
  material.scale = scale;
  material.seed = seed;
  material.gloss = gloss;
  return material;
}

/// Color at the surface coordinates (u, v) [m], each channel about [0, 1]. Detail smaller than
/// `footprint` [m], the size of a pixel there, fades out to avoid flicker.
Eigen::Vector3f albedo(const Material& material, float u, float v, float footprint);

}  // namespace mms
