#include "mms/simulation/people/person_style.hpp"

#include <array>

#include "mms/core/hash_noise.hpp"

namespace mms {
namespace {

using Color = Eigen::Vector3f;

/// Independent random values, one per `what`.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(hash_of(seed, 0x70657273)) {}

  float between(std::uint64_t what, float low, float high) const {
    return low + (high - low) * uniform_of(hash_of(seed_, what));
  }
  bool chance(std::uint64_t what, float share) const { return between(what, 0, 1) < share; }

  /// One of `colors`, slightly lighter or darker.
  template <std::size_t N>
  Color color(std::uint64_t what, const std::array<Color, N>& colors) const {
    const auto index = static_cast<std::size_t>(between(what, 0.0F, static_cast<float>(N) - 1e-3F));
    return between(what + 1000, 0.85F, 1.1F) * colors[index];
  }

 private:
  std::uint64_t seed_;
};

const std::array<Color, 6> kSkins = {Color(0.87F, 0.68F, 0.57F), Color(0.80F, 0.59F, 0.46F),
                                     Color(0.72F, 0.51F, 0.37F), Color(0.56F, 0.38F, 0.26F),
                                     Color(0.40F, 0.26F, 0.18F), Color(0.83F, 0.64F, 0.50F)};
const std::array<Color, 6> kHairs = {Color(0.06F, 0.05F, 0.05F), Color(0.15F, 0.09F, 0.06F),
                                     Color(0.28F, 0.18F, 0.10F), Color(0.55F, 0.40F, 0.20F),
                                     Color(0.42F, 0.41F, 0.40F), Color(0.36F, 0.15F, 0.07F)};
const std::array<Color, 9> kShirts = {
    Color(0.16F, 0.25F, 0.45F), Color(0.55F, 0.10F, 0.10F), Color(0.45F, 0.47F, 0.50F),
    Color(0.80F, 0.80F, 0.78F), Color(0.12F, 0.32F, 0.22F), Color(0.10F, 0.10F, 0.12F),
    Color(0.32F, 0.52F, 0.70F), Color(0.50F, 0.36F, 0.20F), Color(0.60F, 0.25F, 0.45F)};
const std::array<Color, 2> kVests = {Color(0.98F, 0.40F, 0.05F), Color(0.78F, 0.95F, 0.12F)};
const std::array<Color, 6> kTrousers = {Color(0.10F, 0.13F, 0.22F), Color(0.20F, 0.28F, 0.42F),
                                        Color(0.12F, 0.12F, 0.13F), Color(0.36F, 0.35F, 0.33F),
                                        Color(0.45F, 0.37F, 0.25F), Color(0.22F, 0.25F, 0.18F)};
const std::array<Color, 4> kShoes = {Color(0.07F, 0.06F, 0.06F), Color(0.30F, 0.20F, 0.11F),
                                     Color(0.52F, 0.38F, 0.20F), Color(0.55F, 0.55F, 0.57F)};
const std::array<Color, 5> kHats = {Color(0.93F, 0.76F, 0.08F), Color(0.90F, 0.90F, 0.88F),
                                    Color(0.10F, 0.28F, 0.65F), Color(0.78F, 0.12F, 0.08F),
                                    Color(0.95F, 0.45F, 0.08F)};

Headwear headwear(const Dice& dice) {
  const float value = dice.between(10, 0.0F, 1.0F);
  if (value < 0.35F) return Headwear::kHardHat;
  if (value < 0.52F) return Headwear::kCap;
  return value < 0.72F ? Headwear::kLongHair : Headwear::kHair;
}

}  // namespace

PersonStyle random_person_style(std::uint64_t seed) {
  const Dice dice(seed);
  PersonStyle style;
  style.headwear = headwear(dice);
  const float tall = style.headwear == Headwear::kLongHair ? 1.76F : 1.95F;
  style.height = 0.5F * (dice.between(1, 1.5F, tall) + dice.between(2, 1.6F, tall));
  style.build = dice.between(3, 0.9F, 1.16F);
  style.vest = dice.chance(4, 0.55F);
  style.short_sleeves = dice.chance(5, 0.35F);
  style.gloves = dice.chance(6, 0.25F);
  style.carries_box = dice.chance(7, 0.2F);
  style.working = dice.chance(8, 0.4F);
  style.skin = dice.color(20, kSkins);
  style.hair = dice.color(21, kHairs);
  style.shirt = dice.color(22, kShirts);
  style.vest_color = dice.color(23, kVests);
  style.trousers = dice.color(24, kTrousers);
  style.shoes = dice.color(25, kShoes);
  style.hat = dice.color(26, kHats);
  style.seed = static_cast<std::uint32_t>(hash_of(seed, 27));
  return style;
}

}  // namespace mms
