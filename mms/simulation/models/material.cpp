#include "mms/simulation/models/material.hpp"

#include <algorithm>
#include <cmath>

#include "mms/core/hash_noise.hpp"

namespace mms {
namespace {

/// Noise with features of `size` [m], which fades out if a pixel covers more than one of them.
float stains(std::uint32_t seed, float u, float v, float size, float footprint) {
  const float visible = 1.0F - footprint / size;
  return visible <= 0.0F ? 0.0F : visible * value_noise(seed, u / size, v / size);
}

/// Uniform in [0, 1); u and v are integers.
float random_of_cell(std::uint32_t seed, float u, float v) {
  const auto cell = [](float value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
  };
  return uniform_of(hash_of(seed, cell(u) * 7919 + cell(v)));
}

/// 1 on a joint of half-width `half` at multiples of `period`, blurred by the footprint.
float joint(float value, float period, float half, float footprint) {
  const float off = std::abs(value - period * std::round(value / period));
  return std::clamp((half - off) / std::max(footprint, 1e-3F) + 0.5F, 0.0F, 1.0F);
}

Eigen::Vector3f plaster(const Material& m, float u, float v, float footprint) {
  const float tone = 1.0F + 0.10F * stains(m.seed, u, v, 7.0F * m.scale, footprint) +
                     0.10F * stains(m.seed + 1, u, v, m.scale, footprint) +
                     0.08F * stains(m.seed + 2, u, v, 0.3F * m.scale, footprint);
  return tone * m.color;
}

Eigen::Vector3f planks(const Material& m, float u, float v, float footprint) {
  const float row = std::floor(v / m.scale);
  const float length = 9.0F * m.scale;
  const float along = u + length * random_of_cell(m.seed, row, 0.0F);
  const float board = random_of_cell(m.seed + 1, row, std::floor(along / length));
  const float grain = stains(m.seed + 2, 0.15F * u, v, 0.15F * m.scale, footprint);
  const float gap =
      std::max(joint(v, m.scale, 0.004F, footprint), joint(along, length, 0.004F, footprint));
  const float tone = (0.75F + 0.45F * board + 0.12F * grain) * (1.0F - 0.6F * gap);
  return tone * m.color;
}

Eigen::Vector3f tiles(const Material& m, float u, float v, float footprint) {
  const float gap =
      std::max(joint(u, m.scale, 0.008F, footprint), joint(v, m.scale, 0.008F, footprint));
  const float tone = 1.0F + 0.08F * stains(m.seed, u, v, 0.3F * m.scale, footprint);
  return tone * (m.color + gap * (m.second - m.color));
}

Eigen::Vector3f poster(const Material& m, float u, float v, float footprint) {
  const float fine = random_of_cell(m.seed, std::floor(u / m.scale), std::floor(v / m.scale));
  const float coarse = random_of_cell(m.seed + 1, std::floor(u / (3.0F * m.scale)),
                                      std::floor(v / (2.0F * m.scale)));
  const float tone = 1.0F + 0.15F * stains(m.seed + 2, u, v, 0.3F * m.scale, footprint);
  const Eigen::Vector3f base = m.color + coarse * (m.second - m.color);
  return tone * (fine < 0.35F ? Eigen::Vector3f(0.35F * base) : base);
}

Eigen::Vector3f hazard(const Material& m, float u, float v, float footprint) {
  const float along = 0.70710678F * (u + v);
  const float across = 0.70710678F * (u - v);
  const float wave = std::abs(along - 2.0F * m.scale * std::round(along / (2.0F * m.scale)));
  const float blur = std::max(footprint, 1e-3F);
  const float share = std::clamp((0.5F * m.scale - wave) / blur + 0.5F, 0.0F, 1.0F);
  const float tone = 1.0F + 0.1F * stains(m.seed, along, across, 0.05F, footprint);
  return tone * (m.color + share * (m.second - m.color));
}

Eigen::Vector3f concrete(const Material& m, float u, float v, float footprint) {
  constexpr float kSlab = 4.0F;  // [m]
  const float slab = random_of_cell(m.seed, std::floor(u / kSlab), std::floor(v / kSlab));
  const float gap =
      std::max(joint(u, kSlab, 0.006F, footprint), joint(v, kSlab, 0.006F, footprint));
  const float wear = stains(m.seed + 3, 0.35F * u, v, 0.6F, footprint);
  const float crack = std::abs(stains(m.seed + 5, u, v, 1.3F, footprint));
  const float dark = crack < 0.012F && wear > 0.1F ? 0.25F : 0.0F;
  const float tone = 0.95F + 0.08F * (slab - 0.5F) + 0.09F * wear +
                     0.10F * stains(m.seed + 1, u, v, 0.22F, footprint) +
                     0.09F * stains(m.seed + 2, u, v, 0.05F, footprint) +
                     0.08F * stains(m.seed + 4, u, v, 0.015F, footprint);
  return tone * (1.0F - 0.5F * gap) * (1.0F - dark) * m.color;
}

/// 1 in a rectangle about (u0, v0), with edges blurred by the footprint.
float patch(float u, float v, float u0, float v0, float half_u, float half_v, float footprint) {
  const float soft = std::max(footprint, 1e-3F);
  const auto inside = [&](float off, float half) {
    return std::clamp((half - std::abs(off)) / soft + 0.5F, 0.0F, 1.0F);
  };
  return inside(u - u0, half_u) * inside(v - v0, half_v);
}

Eigen::Vector3f cardboard(const Material& m, float u, float v, float footprint) {
  const float tone = 1.0F + 0.06F * stains(m.seed, u, v, 0.15F, footprint) +
                     0.05F * stains(m.seed + 1, 8.0F * u, v, 0.05F, footprint);
  Eigen::Vector3f color = tone * m.color;
  const auto mix = [&](const Eigen::Vector3f& other, float share) {
    color += share * (other - color);
  };
  const float cu = std::floor(u / m.scale);
  const float cv = std::floor(v / m.scale);
  const float du = u - cu * m.scale;
  const float dv = v - cv * m.scale;
  const auto chance = [&](std::uint32_t what) { return random_of_cell(m.seed + what, cu, cv); };
  mix({0.72F, 0.60F, 0.42F}, 0.8F * patch(0.0F, dv, 0.0F, 0.5F * m.scale, 1.0F, 0.025F, footprint));
  if (chance(2) < 0.6F) {  // a print of bars, such as a logo with text
    const float u0 = m.scale * (0.25F + 0.3F * chance(3));
    const float v0 = m.scale * 0.72F;
    const float half = m.scale * (0.10F + 0.08F * chance(4));
    mix(m.second, 0.9F * patch(du, dv, u0, v0, half, 0.10F * m.scale, footprint));
    mix(m.color, patch(du, dv, u0 + 0.2F * half, v0, 0.4F * half, 0.05F * m.scale, footprint));
    mix(m.second, 0.8F * patch(du, dv, u0, 0.57F * m.scale, 1.3F * half, 0.012F, footprint));
  }
  if (chance(5) < 0.55F) {  // a shipping label with a bar code
    const float u0 = m.scale * (0.3F + 0.4F * chance(6));
    const float v0 = m.scale * 0.26F;
    mix({0.9F, 0.9F, 0.88F}, patch(du, dv, u0, v0, 0.07F, 0.05F, footprint));
    const float bars = patch(du, dv, u0, v0 - 0.015F, 0.055F, 0.02F, footprint);
    const float bar = random_of_cell(m.seed + 7, std::floor(du / 0.006F), cu) < 0.5F ? 1.0F : 0.0F;
    const float fine = std::clamp(1.0F - footprint / 0.006F, 0.0F, 1.0F);
    mix({0.08F, 0.08F, 0.08F}, bars * (fine * bar + 0.5F * (1.0F - fine)));
  }
  return color;
}

Eigen::Vector3f brushed(const Material& m, float u, float v, float footprint) {
  const float tone = 1.0F + 0.07F * stains(m.seed, 0.1F * u, v, 0.01F, footprint) +
                     0.06F * stains(m.seed + 1, u, v, 0.25F, footprint);
  const float scratch = stains(m.seed + 2, u, 0.2F * v, 0.05F, footprint);
  return (scratch > 0.8F ? 0.7F : 1.0F) * tone * m.color;
}

Eigen::Vector3f cloth(const Material& m, float u, float v, float footprint) {
  const float tone = 1.0F + 0.14F * stains(m.seed, 1.7F * u, 0.6F * v, 0.08F, footprint) +
                     0.06F * stains(m.seed + 1, u, v, 0.012F, footprint);
  return tone * m.color;
}

Eigen::Vector3f pallet(const Material& m, float u, float v, float footprint) {
  const float row = std::floor(v / m.scale);
  const float board = random_of_cell(m.seed, row, 0.0F);
  const float grain = stains(m.seed + 1, 0.15F * u, v, 0.012F, footprint);
  const float gap = joint(v, m.scale, 0.012F, footprint);
  return (0.8F + 0.35F * board + 0.15F * grain) * (1.0F - 0.85F * gap) * m.color;
}

}  // namespace

Eigen::Vector3f albedo(const Material& material, float u, float v, float footprint) {
  switch (material.pattern) {
    case Pattern::kPlaster:
      return plaster(material, u, v, footprint);
    case Pattern::kPlanks:
      return planks(material, u, v, footprint);
    case Pattern::kTiles:
      return tiles(material, u, v, footprint);
    case Pattern::kPoster:
      return poster(material, u, v, footprint);
    case Pattern::kHazard:
      return hazard(material, u, v, footprint);
    case Pattern::kConcrete:
      return concrete(material, u, v, footprint);
    case Pattern::kCardboard:
      return cardboard(material, u, v, footprint);
    case Pattern::kBrushed:
      return brushed(material, u, v, footprint);
    case Pattern::kCloth:
      return cloth(material, u, v, footprint);
    case Pattern::kPallet:
      return pallet(material, u, v, footprint);
    case Pattern::kPlain:
      break;
  }
  return (1.0F + 0.12F * stains(material.seed, u, v, material.scale, footprint)) * material.color;
}

}  // namespace mms
