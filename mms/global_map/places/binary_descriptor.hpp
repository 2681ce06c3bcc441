#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace mms {

/// Binary descriptor of the surroundings of a pixel (ORB; Rublee et al., ICCV 2011).
struct BinaryDescriptor {
  static constexpr std::size_t kBits = 256;

  std::array<std::uint64_t, kBits / 64> words{};  ///< bit i is bit i % 64 of word i / 64

  bool bit(std::size_t i) const { return ((words[i / 64] >> (i % 64)) & 1U) != 0; }

  bool operator==(const BinaryDescriptor&) const = default;
};

/// Number of bits that differ, in [0, 256].
inline int hamming_distance(const BinaryDescriptor& a, const BinaryDescriptor& b) {
  int distance = 0;
  for (std::size_t i = 0; i < a.words.size(); ++i) {
    distance += std::popcount(a.words[i] ^ b.words[i]);
  }
  return distance;
}

}  // namespace mms
