#pragma once

#include <tsl/robin_map.h>

#include <Eigen/Core>
#include <algorithm>
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

  /// Bytes of the cells and the index, without memory that a cell allocates itself.
  std::size_t memory_bytes() const {
    return entries_.capacity() * sizeof(Entry) +
           index_.bucket_count() * (sizeof(VoxelKey) + 2 * sizeof(std::uint32_t));
  }

  VoxelKey key(const Eigen::Vector3f& point) const { return voxel_key(point, inverse_size_); }

  const Cell* find(const VoxelKey& key) const {
    const auto found = index_.find(key);
    return found == index_.end() ? nullptr : &entries_[found->second].cell;
  }

  /// The cell at `key`, inserted if absent and marked as written. The reference is valid until the
  /// next insertion or removal.
  Cell& touch(const VoxelKey& key) {
    const auto [found, added] = index_.try_emplace(key, static_cast<std::uint32_t>(size()));
    if (added) entries_.push_back({key, 0, Cell{}});
    Entry& entry = entries_[found->second];
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
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      index_.emplace(entries_[i].key, static_cast<std::uint32_t>(i));
    }
  }

  void clear() {
    entries_.clear();
    index_.clear();
  }

  Eigen::Vector3f voxel_centre(const VoxelKey& k) const {
    return (Eigen::Vector3f(static_cast<float>(k.x), static_cast<float>(k.y),
                            static_cast<float>(k.z)) +
            Eigen::Vector3f::Constant(0.5F)) *
           voxel_size_;
  }

 private:
  float voxel_size_;
  float inverse_size_;
  std::size_t max_cells_;
  std::uint64_t tick_ = 0;
  std::vector<Entry> entries_;
  tsl::robin_map<VoxelKey, std::uint32_t, VoxelKeyHash> index_;
};

}  // namespace mms
