#include "mms/simulation/material.hpp"

#include <algorithm>
#include <cmath>

#include "mms/simulation/hash_noise.hpp"

namespace mms {
namespace {

/// Noise with features of `size` [m], gone where a pixel covers more than one of them.
float stains(std::uint32_t seed, float u, float v, float size, float footprint) {
  const float visible = 1.0F - footprint / size;
  return visible <= 0.0F ? 0.0F : visible * value_noise(seed, u / size, v / size);
}

/// Uniform in [0, 1); u and v are whole numbers.
float random_of_cell(std::uint32_t seed, float u, float v) {
  const auto cell = [](float value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
  };
  return uniform_of(hash_of(seed, cell(u) * 7919 + cell(v)));
}

/// 1 on a joint of half-width `half` around multiples of `period`, blurred to the footprint.
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

Eigen::Vector3f stripes(const Material& m, float u, float v, float footprint) {
  const float wave = std::abs(u - 2.0F * m.scale * std::round(u / (2.0F * m.scale)));
  const float blur = std::max(footprint, 1e-3F);
  const float share = std::clamp((0.5F * m.scale - wave) / blur + 0.5F, 0.0F, 1.0F);
  const float tone = 1.0F + 0.1F * stains(m.seed, u, v, 0.05F, footprint);
  return tone * (m.color + share * (m.second - m.color));
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
    case Pattern::kStripes:
      return stripes(material, u, v, footprint);
    case Pattern::kPlain:
      break;
  }
  return (1.0F + 0.12F * stains(material.seed, u, v, material.scale, footprint)) * material.color;
}

}  // namespace mms
