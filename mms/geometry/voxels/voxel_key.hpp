#pragma once

#include <Eigen/Core>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace mms {

/// [-]: radius of the ball around a cube over the cube's side. Source: half of sqrt(3).
inline constexpr float kHalfDiagonal = 0.8660254F;

/// Integer coordinates of a cubic voxel.
struct VoxelKey {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;

  auto operator<=>(const VoxelKey&) const = default;
};

/// Voxel of `point` [m] in a grid of 1 / `inverse_size` [m]; the point must be finite and within
/// 2^31 voxels of the origin.
inline VoxelKey voxel_key(const Eigen::Vector3f& point, float inverse_size) {
  return {static_cast<std::int32_t>(std::floor(point.x() * inverse_size)),
          static_cast<std::int32_t>(std::floor(point.y() * inverse_size)),
          static_cast<std::int32_t>(std::floor(point.z() * inverse_size))};
}

/// Spatial hash of Teschner et al. (2003), mixed so that the low bits are usable.
struct VoxelKeyHash {
  std::size_t operator()(const VoxelKey& key) const {
    std::uint64_t h = static_cast<std::uint32_t>(key.x) * 73856093ULL;
    h ^= static_cast<std::uint32_t>(key.y) * 19349669ULL;
    h ^= static_cast<std::uint32_t>(key.z) * 83492791ULL;
    h ^= h >> 29;
    h *= 0xbf58476d1ce4e5b9ULL;
    return static_cast<std::size_t>(h ^ (h >> 32));
  }
};

}  // namespace mms
