#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace mms {

/// Headwear or hair of a person.
enum class Headwear : std::uint8_t { kHair, kLongHair, kCap, kHardHat };

/// Appearance of a person. Colors are red, green, blue in [0, 1].
struct PersonStyle {
  float height = 1.75F;  ///< from the floor to the top of the skull [m]
  float build = 1.0F;    ///< body width relative to the average, 0.88 to 1.2
  Headwear headwear = Headwear::kHair;
  bool vest = false;           ///< a warning vest with reflective bands over the shirt
  bool short_sleeves = false;  ///< bare forearms
  bool gloves = false;
  bool carries_box = false;  ///< holds a cardboard box with both arms
  bool working = false;      ///< stands at a rack and moves its arms if it does not walk
  Eigen::Vector3f skin{0.80F, 0.60F, 0.48F};
  Eigen::Vector3f hair{0.12F, 0.08F, 0.06F};
  Eigen::Vector3f shirt{0.20F, 0.28F, 0.42F};
  Eigen::Vector3f vest_color{0.95F, 0.42F, 0.05F};
  Eigen::Vector3f trousers{0.12F, 0.14F, 0.20F};
  Eigen::Vector3f shoes{0.08F, 0.07F, 0.07F};
  Eigen::Vector3f hat{0.92F, 0.78F, 0.10F};  ///< of the hard hat or the cap
  std::uint32_t seed = 1;                    ///< of folds, stains, prints and motion phases
};

/// Random appearance of a warehouse worker, determined by the seed.
PersonStyle random_person_style(std::uint64_t seed);

}  // namespace mms
