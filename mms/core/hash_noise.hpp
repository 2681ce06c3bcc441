#pragma once

#include <cmath>
#include <cstdint>

namespace mms {

/// Stateless random numbers: every value is a hash of its key (seed, frame, pixel), so a pixel does
/// not depend on the thread that renders it.
constexpr std::uint64_t hash_of(std::uint64_t a) {
  a = (a ^ (a >> 30)) * 0xbf58476d1ce4e5b9ULL;
  a = (a ^ (a >> 27)) * 0x94d049bb133111ebULL;
  return a ^ (a >> 31);
}
constexpr std::uint64_t hash_of(std::uint64_t a, std::uint64_t b) {
  return hash_of(hash_of(a + 0x9e3779b97f4a7c15ULL) + b);
}

/// Uniform in [0, 1).
constexpr float uniform_of(std::uint64_t hash) {
  return static_cast<float>(hash >> 40) * 0x1p-24F;
}

/// Approximately normal with mean 0 and variance 1: the sum of four uniforms, within +-3.5.
constexpr float normal_of(std::uint64_t hash) {
  const auto part = [&](int shift) { return static_cast<float>((hash >> shift) & 0xffffU); };
  const float sum = part(0) + part(16) + part(32) + part(48);
  return (sum * 0x1p-16F - 2.0F) * 1.7320508F;
}

/// Smooth noise in [-1, 1] with a correlation length of 1.
inline float value_noise(std::uint32_t seed, float u, float v) {
  const float fu = std::floor(u);
  const float fv = std::floor(v);
  const auto corner = [&](int du, int dv) {
    std::uint32_t h = seed + static_cast<std::uint32_t>(static_cast<int>(fu) + du) * 0x9e3779b1U;
    h ^= static_cast<std::uint32_t>(static_cast<int>(fv) + dv) * 0x85ebca77U;
    h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
    h = (h ^ (h >> 12)) * 0x297a2d39U;
    return static_cast<float>(h >> 8) * 0x1p-23F - 1.0F;
  };
  const float a = (u - fu) * (u - fu) * (3.0F - 2.0F * (u - fu));
  const float b = (v - fv) * (v - fv) * (3.0F - 2.0F * (v - fv));
  const auto mix = [](float from, float to, float share) { return from + share * (to - from); };
  return mix(mix(corner(0, 0), corner(1, 0), a), mix(corner(0, 1), corner(1, 1), a), b);
}

}  // namespace mms
