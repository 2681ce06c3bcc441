#pragma once

#include <tsl/robin_map.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/geometry/voxels/block_cells.hpp"
#include "mms/geometry/voxels/voxel_key.hpp"

namespace mms {

/// A voxel of the static map; means are weighted by 1 / variance of the points.
struct Voxel {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< mean, world frame [m]
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();    ///< mean, not normalised; zero if unknown
  Eigen::Vector3f color = Eigen::Vector3f::Zero();     ///< mean red, green, blue in [0, 255]
  float weight = 0.0F;                                 ///< sum of the points' weights
  std::uint32_t last_frame = 0;    ///< number of the last frame that measured it
  std::uint16_t hits = 0;          ///< views that measured it (`StaticMap`)
  std::uint16_t seen_through = 0;  ///< keyframes that measured behind it
  std::uint16_t cell = 0;          ///< place in its block
};

/// [-]: least length of a mean normal. Source: above the rounding of means of unit vectors.
constexpr float kMinMeanNormal = 1e-3F;

/// Whether a voxel has normals that do not cancel out.
inline bool has_normal(const Voxel& voxel) {
  return voxel.normal.norm() > kMinMeanNormal;
}

inline Rgb to_rgb(const Eigen::Vector3f& color) {
  const auto channel = [](float value) { return static_cast<std::uint8_t>(value + 0.5F); };
  return {channel(color.x()), channel(color.y()), channel(color.z())};
}

/// A cube of voxels (`BlockCells`) of which only the occupied ones are stored.
struct VoxelBlock {
  /// By cell: 1 + index into `voxels`, 0 for none.
  using Slots = std::array<std::uint16_t, BlockCells::kCount>;

  VoxelKey key;  ///< in units of the block's side
  std::vector<Voxel> voxels;
  std::unique_ptr<Slots> slots;  ///< null for a block of few voxels, which are searched one by one
  std::uint32_t last_frame = 0;  ///< number of the last frame that measured in it
  std::uint16_t views = 0;       ///< views that measured in it with little noise

  /// In units of the voxel's side.
  VoxelKey voxel_key(const Voxel& voxel) const { return BlockCells::voxel_of(key, voxel.cell); }

  /// Index into `voxels`; their number where the cell has none.
  std::size_t index_of(std::uint16_t cell) const {
    if (slots) {
      const std::uint16_t slot = (*slots)[cell];
      return slot == 0 ? voxels.size() : slot - 1U;
    }
    std::size_t index = 0;
    while (index < voxels.size() && voxels[index].cell != cell) ++index;
    return index;
  }
};

/// Sparse voxels in hashed blocks, so that whole blocks can be culled against a camera's view.
/// Iteration follows the order of creation and so depends on the input alone.
class VoxelGrid {
 public:
  /// @param voxel_size  side of a voxel [m]
  explicit VoxelGrid(double voxel_size);

  /// Reference to a voxel; valid until voxels are erased.
  struct Place {
    VoxelBlock* block = nullptr;
    std::size_t block_index = 0;  ///< into `blocks`
    std::size_t index = 0;        ///< into the block's voxels

    Voxel& voxel() const { return block->voxels[index]; }
  };

  /// The voxel that holds `point` (world frame [m]), created where there is none.
  Place place(const Eigen::Vector3f& point) { return place(voxel_key(point, inverse_size_)); }
  Place place(const VoxelKey& key);

  /// The same; the reference is valid until the next voxel is created.
  Voxel& at(const Eigen::Vector3f& point) { return place(point).voxel(); }

  /// The voxel at `key`, or null.
  const Voxel* find(const VoxelKey& key) const;

  /// The block at `key`, in units of its side, or null.
  VoxelBlock* find_block(const VoxelKey& key);

  /// Removes the voxel at `key`, if there is one.
  void erase(const VoxelKey& key);

  /// Removes the voxels of `block` for which `remove(voxel)` is true; returns how many.
  template <class Predicate>
  std::size_t erase_if(VoxelBlock& block, const Predicate& remove) {
    std::size_t erased = 0;
    for (std::size_t i = 0; i < block.voxels.size();) {
      remove(block.voxels[i]) ? erase(block, i), ++erased : ++i;
    }
    return erased;
  }

  /// Calls `visit(block)` for the blocks of all regions, cubes of blocks, for which
  /// `may_matter(center, radius)` holds of the ball around the region (world frame [m]).
  template <class MayMatter, class Visit>
  void for_each_block(const MayMatter& may_matter, const Visit& visit) {
    const auto side = static_cast<float>(block_size() * kRegionSide);
    for (const Region& region : regions_) {
      const Eigen::Vector3f corner(static_cast<float>(region.key.x),
                                   static_cast<float>(region.key.y),
                                   static_cast<float>(region.key.z));
      const Eigen::Vector3f center = (corner.array() + 0.5F).matrix() * side;
      if (!may_matter(center, kHalfDiagonal * side)) continue;
      for (const std::uint32_t index : region.blocks) visit(blocks_[index]);
    }
  }

  /// The same content in voxels of twice the side: means of means, the larger count of hits.
  /// @param keeps_views  of the blocks. Those of scans begin anew: their rays hit other voxels of a
  ///                     block in each view, so that many are seen once.
  VoxelGrid coarsened(bool keeps_views) const;

  std::deque<VoxelBlock>& blocks() { return blocks_; }
  const std::deque<VoxelBlock>& blocks() const { return blocks_; }

  double voxel_size() const { return voxel_size_; }
  double block_size() const { return voxel_size_ * BlockCells::kSide; }
  std::size_t size() const { return size_; }
  std::size_t memory_bytes() const;

 private:
  /// [-]: binary logarithm of the blocks along the side of a region. Source: a region of 1.28 m at
  /// voxels of 2 cm; a map of a hundred thousand blocks has some thousand.
  static constexpr int kRegionBits = 3;
  static constexpr int kRegionSide = 1 << kRegionBits;

  struct Region {
    VoxelKey key;  // in units of the region's side
    std::vector<std::uint32_t> blocks;
  };

  std::size_t block_index(const VoxelKey& key);
  void add_to_region(const VoxelKey& block, std::uint32_t index);
  void make_slots(VoxelBlock& block);
  void erase(VoxelBlock& block, std::size_t index);

  double voxel_size_;
  float inverse_size_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;       // of all blocks' voxel vectors
  std::size_t slots_ = 0;          // blocks that have them
  std::size_t last_block_ = 0;     // neighbouring points mostly share a block
  std::deque<VoxelBlock> blocks_;  // a vector would copy every block's table when it grows
  tsl::robin_map<VoxelKey, std::uint32_t, VoxelKeyHash> index_;
  std::vector<Region> regions_;
  tsl::robin_map<VoxelKey, std::uint32_t, VoxelKeyHash> region_index_;
};

}  // namespace mms
