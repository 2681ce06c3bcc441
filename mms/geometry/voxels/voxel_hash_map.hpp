#pragma once

#include <tsl/robin_map.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "mms/geometry/voxels/voxel_key.hpp"

namespace mms {

/// Sparse voxel grid, the storage of the local maps: constant-time access, memory bounded by
/// removing the least recently written cells. The order of cells depends only on the history, not
/// on addresses or threads.
template <class Cell>
class VoxelHashMap {
 public:
  struct Entry {
    VoxelKey key;
    std::uint64_t touched = 0;  ///< tick of the last write
    Cell cell{};
  };

  /// @param voxel_size edge of a voxel [m], > 0
  /// @param max_cells largest number of cells, >= 1
  VoxelHashMap(double voxel_size, std::size_t max_cells)
      : voxel_size_(static_cast<float>(voxel_size)),
        inverse_size_(1.0F / voxel_size_),
        max_cells_(std::max<std::size_t>(1, max_cells)) {}

  float voxel_size() const { return voxel_size_; }
  std::size_t size() const { return entries_.size(); }
  bool empty() const { return entries_.empty(); }
  const std::vector<Entry>& entries() const { return entries_; }

  VoxelKey key(const Eigen::Vector3f& point) const { return voxel_key(point, inverse_size_); }

  const Cell* find(const VoxelKey& key) const {
    const std::uint32_t slot = slot_in(find_block(block_of(key)), key);
    return slot == 0 ? nullptr : &entries_[slot - 1].cell;
  }

  /// Calls `visit(cell)` for the cells of the box from `low` to `high`, both included, x before y
  /// before z. Each block of cells is searched once.
  template <class Visit>
  void for_each_in(const VoxelKey& low, const VoxelKey& high, const Visit& visit) const {
    const VoxelKey first = block_of(low);
    const VoxelKey last = block_of(high);
    if (last.x - first.x > 1 || last.y - first.y > 1 || last.z - first.z > 1) {
      visit_one_by_one(low, high, visit);
      return;
    }
    std::array<const Block*, 8> blocks{};
    for (int z = first.z; z <= last.z; ++z) {
      for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
          blocks[corner(first, {x, y, z})] = find_block({x, y, z});
        }
      }
    }
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
          const VoxelKey key{x, y, z};
          const std::uint32_t slot = slot_in(blocks[corner(first, block_of(key))], key);
          if (slot != 0) visit(entries_[slot - 1].cell);
        }
      }
    }
  }

  /// The cell at `key`, inserted if absent and marked as written. The reference is valid until the
  /// next insertion or removal.
  Cell& touch(const VoxelKey& key) {
    std::uint32_t& slot = make_slot(key);
    if (slot == 0) {
      entries_.push_back({key, 0, Cell{}});
      slot = static_cast<std::uint32_t>(size());
    }
    Entry& entry = entries_[slot - 1];
    entry.touched = ++tick_;
    return entry.cell;
  }

  /// Removes the least recently written cells above the bound, and a tenth more, so that this
  /// happens rarely.
  void enforce_bound() {
    if (size() <= max_cells_) return;
    std::vector<std::uint64_t> ticks;
    ticks.reserve(size());
    for (const Entry& entry : entries_) ticks.push_back(entry.touched);
    const std::size_t surplus = size() - max_cells_ + max_cells_ / 10;
    const auto oldest_kept = ticks.begin() + static_cast<std::ptrdiff_t>(surplus);
    std::nth_element(ticks.begin(), oldest_kept, ticks.end());
    remove_if([limit = *oldest_kept](const Entry& entry) { return entry.touched < limit; });
  }

  /// Removes cells whose center is farther than `distance` [m] from `centre`.
  void remove_farther_than(const Eigen::Vector3f& centre, float distance) {
    remove_if([&](const Entry& entry) {
      return (voxel_centre(entry.key) - centre).squaredNorm() > distance * distance;
    });
  }

  template <class Predicate>
  void remove_if(const Predicate& predicate) {
    const auto end = std::remove_if(entries_.begin(), entries_.end(), predicate);
    if (end == entries_.end()) return;
    entries_.erase(end, entries_.end());
    index_.clear();
    blocks_.clear();
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      make_slot(entries_[i].key) = static_cast<std::uint32_t>(i + 1);
    }
  }

  void clear() {
    entries_.clear();
    index_.clear();
    blocks_.clear();
  }

  Eigen::Vector3f voxel_centre(const VoxelKey& k) const {
    return (Eigen::Vector3f(static_cast<float>(k.x), static_cast<float>(k.y),
                            static_cast<float>(k.z)) +
            Eigen::Vector3f::Constant(0.5F)) *
           voxel_size_;
  }

 private:
  /// [-]: binary logarithm of the side of a block of cells. Source: the 27 cells around one are
  /// then in 3.4 blocks on average.
  static constexpr int kBlockBits = 2;

  /// 1 + the place of each cell in `entries_`, 0 for none.
  using Block = std::array<std::uint32_t, 1 << (3 * kBlockBits)>;

  static VoxelKey block_of(const VoxelKey& key) {
    return {key.x >> kBlockBits, key.y >> kBlockBits, key.z >> kBlockBits};
  }

  /// Place of a block among the eight from `first` on.
  static std::size_t corner(const VoxelKey& first, const VoxelKey& block) {
    return static_cast<std::size_t>((block.x - first.x) | (block.y - first.y) << 1 |
                                    (block.z - first.z) << 2);
  }

  static std::size_t place_in_block(const VoxelKey& key) {
    constexpr int kMask = (1 << kBlockBits) - 1;
    return static_cast<std::size_t>((key.x & kMask) | (key.y & kMask) << kBlockBits |
                                    (key.z & kMask) << (2 * kBlockBits));
  }

  const Block* find_block(const VoxelKey& block) const {
    const auto found = index_.find(block);
    return found == index_.end() ? nullptr : &blocks_[found->second];
  }

  static std::uint32_t slot_in(const Block* block, const VoxelKey& key) {
    return block == nullptr ? 0 : (*block)[place_in_block(key)];
  }

  std::uint32_t& make_slot(const VoxelKey& key) {
    const auto [found, added] =
        index_.try_emplace(block_of(key), static_cast<std::uint32_t>(blocks_.size()));
    if (added) blocks_.emplace_back();
    return blocks_[found->second][place_in_block(key)];
  }

  template <class Visit>
  void visit_one_by_one(const VoxelKey& low, const VoxelKey& high, const Visit& visit) const {
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
          if (const Cell* cell = find({x, y, z})) visit(*cell);
        }
      }
    }
  }

  float voxel_size_;
  float inverse_size_;
  std::size_t max_cells_;
  std::uint64_t tick_ = 0;
  std::vector<Entry> entries_;
  std::vector<Block> blocks_;
  tsl::robin_map<VoxelKey, std::uint32_t, VoxelKeyHash> index_;  // of `blocks_`
};

}  // namespace mms
