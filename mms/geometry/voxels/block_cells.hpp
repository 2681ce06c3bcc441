#pragma once

#include <cstdint>

#include "mms/geometry/voxels/voxel_key.hpp"

namespace mms {

/// Numbering of voxels within cubic blocks of kSide^3 voxels, the storage unit of the maps.
struct BlockCells {
  static constexpr int kBits = 3;
  static constexpr int kSide = 1 << kBits;
  static constexpr int kCount = kSide * kSide * kSide;

  /// Block of a voxel, in units of the block's side.
  static VoxelKey block_of(const VoxelKey& voxel) {
    return {voxel.x >> kBits, voxel.y >> kBits, voxel.z >> kBits};
  }

  /// Index of a voxel in its block, in [0, kCount).
  static std::uint16_t cell_of(const VoxelKey& voxel) {
    constexpr int kMask = kSide - 1;
    return static_cast<std::uint16_t>((voxel.x & kMask) | ((voxel.y & kMask) << kBits) |
                                      ((voxel.z & kMask) << (2 * kBits)));
  }

  /// Voxel with that index.
  static VoxelKey voxel_of(const VoxelKey& block, int cell) {
    constexpr int kMask = kSide - 1;
    return {block.x * kSide + (cell & kMask), block.y * kSide + ((cell >> kBits) & kMask),
            block.z * kSide + (cell >> (2 * kBits))};
  }
};

}  // namespace mms
