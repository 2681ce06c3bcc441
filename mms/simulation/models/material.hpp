#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace mms {

enum class Pattern : std::uint8_t {
  kPlain,      ///< one colour with faint stains
  kPlaster,    ///< a wall: stains of several sizes
  kPlanks,     ///< a floor of boards
  kTiles,      ///< square panels with dark joints
  kPoster,     ///< random coloured blocks with a white boundary
  kHazard,     ///< two colours in turn along the diagonal
  kConcrete,   ///< slabs with stains, cracks and tyre marks
  kCardboard,  ///< brown board with tape, prints of the second colour and a white label
  kBrushed,    ///< metal with fine streaks along u
  kCloth,      ///< a garment: faint weave and folds
  kPallet,     ///< boards with open joints
};

/// What a surface looks like, as a function of the place on it.
struct Material {
  Pattern pattern = Pattern::kPlain;
  Eigen::Vector3f color{0.5F, 0.5F, 0.5F};   ///< red, green, blue in [0, 1]
  float scale = 0.1F;                        ///< size of the pattern's elements [m]
  Eigen::Vector3f second{0.3F, 0.3F, 0.3F};  ///< of patterns with two
  std::uint32_t seed = 1;
  float gloss = 0.0F;  ///< share of light that is mirrored, in [0, 1]
};

/// A material of a pattern that has one colour.
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

/// Colour at the surface coordinates (u, v) [m], each channel about [0, 1]. Detail smaller than
/// `footprint` [m], the size of the pixel there, fades out, so that it does not flicker.
Eigen::Vector3f albedo(const Material& material, float u, float v, float footprint);

}  // namespace mms
