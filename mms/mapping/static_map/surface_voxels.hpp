#pragma once

#include <tsl/robin_map.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
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
  VoxelKey key;                                          ///< in units of the block's side
  std::array<std::uint16_t, BlockCells::kCount> slot{};  ///< 1 + index into `voxels`, 0 for none
  std::vector<Voxel> voxels;
  std::uint32_t last_frame = 0;  ///< number of the last frame that measured in it
  std::uint16_t views = 0;       ///< views that measured in it with little noise

  /// In units of the voxel's side.
  VoxelKey voxel_key(const Voxel& voxel) const { return BlockCells::voxel_of(key, voxel.cell); }
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
    std::size_t index = 0;

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

  /// The same content in voxels of twice the side: means of means, the larger count of hits.
  VoxelGrid coarsened() const;

  std::deque<VoxelBlock>& blocks() { return blocks_; }
  const std::deque<VoxelBlock>& blocks() const { return blocks_; }

  double voxel_size() const { return voxel_size_; }
  double block_size() const { return voxel_size_ * BlockCells::kSide; }
  std::size_t size() const { return size_; }
  std::size_t memory_bytes() const;

 private:
  std::size_t block_index(const VoxelKey& key);
  void erase(VoxelBlock& block, std::size_t index);

  double voxel_size_;
  float inverse_size_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;       // of all blocks' voxel vectors
  std::size_t last_block_ = 0;     // neighbouring points mostly share a block
  std::deque<VoxelBlock> blocks_;  // a vector would copy every block's table when it grows
  tsl::robin_map<VoxelKey, std::uint32_t, VoxelKeyHash> index_;
};

}  // namespace mms
