#include "mms/simulation/vehicles/agv_style.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "mms/core/hash_noise.hpp"

namespace mms {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

Material material_of(Pattern pattern, const Eigen::Vector3f& color, float gloss,
                     std::uint64_t seed) {
  Material material;
  material.pattern = pattern;
  material.color = color;
  material.gloss = gloss;
  material.seed = static_cast<std::uint32_t>(seed);
  return material;
}

}  // namespace

AgvStyle::AgvStyle(std::uint64_t seed) : seed_(hash_of(seed, 0x616776)) {
  const std::array<Eigen::Vector3f, 6> colors = {
      Eigen::Vector3f(0.93F, 0.68F, 0.06F), Eigen::Vector3f(0.90F, 0.38F, 0.06F),
      Eigen::Vector3f(0.85F, 0.86F, 0.86F), Eigen::Vector3f(0.10F, 0.30F, 0.62F),
      Eigen::Vector3f(0.48F, 0.51F, 0.54F), Eigen::Vector3f(0.10F, 0.45F, 0.40F)};
  const std::size_t first = hash_of(seed_, 1) % colors.size();
  const std::size_t second = (first + 1 + hash_of(seed_, 2) % (colors.size() - 1)) % colors.size();
  color_ = between(3, 0.85F, 1.05F) * colors[first];
  trim_ = between(4, 0.85F, 1.05F) * colors[second];
}

float AgvStyle::between(std::uint64_t what, float low, float high) const {
  return low + (high - low) * uniform_of(hash_of(seed_, what));
}

bool AgvStyle::chance(std::uint64_t what, float share) const {
  return between(what, 0.0F, 1.0F) < share;
}

float AgvStyle::wave(std::uint64_t what, float period, double seconds) const {
  const double own = static_cast<double>(period * between(what + 500, 0.85F, 1.2F));
  const double turns = seconds / own + static_cast<double>(between(what + 600, 0.0F, 1.0F));
  return std::sin(2.0F * kPi * static_cast<float>(turns - std::floor(turns)));
}

AgvAssembly::Joint AgvStyle::swing(std::uint64_t what, float period, const Eigen::Vector3f& axis,
                                   float center, float amplitude,
                                   const Eigen::Isometry3f& T) const {
  return [style = *this, what, period, axis, center, amplitude, T](const Activity& activity) {
    const float angle = center + amplitude * style.wave(what, period, activity.seconds);
    return T * Eigen::Isometry3f(Eigen::AngleAxisf(angle, axis));
  };
}

Material AgvStyle::paint() const {
  Material material = material_of(Pattern::kPlain, color_, 0.12F, seed_);
  material.scale = 0.25F;
  return material;
}

Material AgvStyle::trim() const {
  return material_of(Pattern::kPlain, trim_, 0.12F, seed_ + 1);
}

Material AgvStyle::dark() const {
  return material_of(Pattern::kPlain, {0.10F, 0.10F, 0.11F}, 0.06F, seed_ + 2);
}

Material AgvStyle::rubber() const {
  return material_of(Pattern::kPlain, {0.06F, 0.06F, 0.06F}, 0.02F, seed_ + 3);
}

Material AgvStyle::steel() const {
  return material_of(Pattern::kBrushed, {0.58F, 0.60F, 0.62F}, 0.3F, seed_ + 4);
}

Material AgvStyle::hazard() const {
  Material material = material_of(Pattern::kHazard, {0.95F, 0.75F, 0.05F}, 0.05F, seed_ + 5);
  material.second = {0.05F, 0.05F, 0.05F};
  material.scale = 0.06F;
  return material;
}

Material AgvStyle::sticker() const {
  Material material = material_of(Pattern::kPoster, {0.90F, 0.90F, 0.88F}, 0.05F, seed_ + 6);
  material.second = trim_;
  material.scale = 0.05F;
  return material;
}

Material AgvStyle::glow(const Eigen::Vector3f& color) const {
  return material_of(Pattern::kPlain, color, 0.3F, seed_ + 7);
}

Material AgvStyle::cardboard(std::uint32_t number) const {
  Material material =
      material_of(Pattern::kCardboard, {0.64F, 0.49F, 0.31F}, 0.0F, hash_of(seed_, 80 + number));
  material.color *= between(90 + number, 0.85F, 1.1F);
  material.second = {between(70 + number, 0.1F, 0.6F), 0.2F, between(60 + number, 0.1F, 0.5F)};
  material.scale = 0.35F;
  return material;
}

Material AgvStyle::wood() const {
  Material material = material_of(Pattern::kPlanks, {0.66F, 0.52F, 0.34F}, 0.0F, seed_ + 8);
  material.scale = 0.1F;
  return material;
}

}  // namespace mms
