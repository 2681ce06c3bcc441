#pragma once

#include <cstddef>
#include <cstdint>

#include "mms/core/hash_noise.hpp"

namespace mms {

/// Sequence of random numbers, equal on every platform for the same seed.
class RandomStream {
 public:
  /// @param seed  any number
  explicit RandomStream(std::uint64_t seed) : seed_(seed) {}

  std::uint64_t bits() { return hash_of(seed_, count_++); }  ///< 64 random bits
  float uniform() { return uniform_of(bits()); }             ///< in [0, 1)
  /// In [from, to).
  float between(float from, float to) { return from + (to - from) * uniform(); }
  /// True with the given probability.
  bool chance(float probability) { return uniform() < probability; }
  /// Seed for another stream.
  std::uint32_t seed() { return static_cast<std::uint32_t>(bits() >> 32); }

  /// Random index in [0, count); count must be positive.
  std::size_t below(std::size_t count) { return bits() % count; }

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

}  // namespace mms
