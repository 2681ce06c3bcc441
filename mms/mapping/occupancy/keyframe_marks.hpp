#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "mms/mapping/occupancy/occupancy_blocks.hpp"

namespace mms {

/// A bit a voxel of a block.
class CellBits {
 public:
  /// Sets the bit; true if it was set before.
  bool test_and_set(std::uint16_t cell) {
    std::uint64_t& word = words_[cell >> 6];
    const std::uint64_t bit = std::uint64_t{1} << (cell & 63);
    const bool before = (word & bit) != 0;
    word |= bit;
    return before;
  }

  std::uint64_t word(std::size_t i) const { return words_[i]; }
  static constexpr std::size_t kWords = BlockCells::kCount / 64;

 private:
  std::array<std::uint64_t, kWords> words_{};
};

/// Observations of a block by one keyframe.
struct BlockMarks {
  VoxelKey key;  ///< of the block
  OccupancyBlock* block = nullptr;
  CellBits hit;   ///< holds a static point
  CellBits free;  ///< a ray passed through
  CellBits keep;  ///< holds a static point that makes no hit: neither hit nor free
  CellBits end;   ///< a ray to it has been followed
};

/// The blocks that one keyframe observes, each with its marks, so that a voxel counts once a
/// keyframe for any number of rays.
class KeyframeMarks {
 public:
  explicit KeyframeMarks(OccupancyBlocks& blocks, std::uint32_t keyframe,
                         std::vector<BlockMarks>& marks)
      : blocks_(blocks), keyframe_(keyframe), marks_(marks) {
    marks_.clear();
  }

  /// Marks of the block that holds `voxel`; valid until the next call.
  BlockMarks& of(const VoxelKey& voxel) {
    const VoxelKey key = BlockCells::block_of(voxel);
    if (!marks_.empty() && marks_[last_].key == key) return marks_[last_];
    std::uint32_t& recent = recent_[recent_place(key)];
    if (recent < marks_.size() && marks_[recent].key == key) return marks_[last_ = recent];
    OccupancyBlock& block = blocks_.at(key);
    if (block.touched != keyframe_) {
      block.touched = keyframe_;
      block.marks = static_cast<std::uint32_t>(marks_.size());
      marks_.emplace_back().key = key;
      marks_.back().block = &block;
    }
    return marks_[last_ = recent = block.marks];
  }

 private:
  /// [-]: binary logarithm of the side of the cube of blocks that has places in `recent_`. Source:
  /// 25.6 m of blocks of 0.8 m, near the diameter of a keyframe's view.
  static constexpr int kRecentBits = 5;

  static std::size_t recent_place(const VoxelKey& block) {
    constexpr int kMask = (1 << kRecentBits) - 1;
    return static_cast<std::size_t>((block.x & kMask) | (block.y & kMask) << kRecentBits |
                                    (block.z & kMask) << (2 * kRecentBits));
  }

  OccupancyBlocks& blocks_;
  std::uint32_t keyframe_;
  std::vector<BlockMarks>& marks_;
  std::size_t last_ = 0;  // voxels along a ray mostly share a block
  // Places of marks by the block's place in a repeated cube: spares the hash of a block on each
  // ray.
  std::vector<std::uint32_t> recent_ =
      std::vector<std::uint32_t>(std::size_t{1} << (3 * kRecentBits));
};

}  // namespace mms
