#pragma once

#include <cstddef>
#include <cstdint>

#include "mms/core/hash_noise.hpp"

namespace mms {

/// Random values one after the other, the same for the same seed everywhere.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : seed_(seed) {}

  std::uint64_t bits() { return hash_of(seed_, count_++); }
  float uniform() { return uniform_of(bits()); }  ///< in [0, 1)
  float between(float from, float to) { return from + (to - from) * uniform(); }
  bool chance(float probability) { return uniform() < probability; }
  std::uint32_t seed() { return static_cast<std::uint32_t>(bits() >> 32); }

  /// Index below `count`, which is not 0.
  std::size_t below(std::size_t count) { return bits() % count; }

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

}  // namespace mms
