#pragma once

#include <tsl/robin_map.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mms/geometry/voxels/voxel_key.hpp"

namespace mms {

/// Point indices in linked lists per cell of a cubic grid. All neighbors of a point within the cell
/// size are in the 27 cells around it.
class CellChains {
 public:
  /// @param count      number of indices that can be inserted
  /// @param cell_size  [m]
  CellChains(std::size_t count, float cell_size) : inverse_size_(1.0F / cell_size), next_(count) {}

  /// Adds index `i`, below `count` and not yet added, at `point` (finite).
  void insert(const Eigen::Vector3f& point, std::size_t i) {
    const auto [cell, is_new] = first_.try_emplace(voxel_key(point, inverse_size_), i);
    next_[i] = is_new ? i : cell->second;
    cell.value() = i;
  }

  /// Calls `visit(i)` for all indices in the 27 cells around `point` (finite).
  template <class Visit>
  void for_each_near(const Eigen::Vector3f& point, const Visit& visit) const {
    const VoxelKey key = voxel_key(point, inverse_size_);
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) for_each_in({key.x + x, key.y + y, key.z + z}, visit);
      }
    }
  }

 private:
  template <class Visit>
  void for_each_in(const VoxelKey& key, const Visit& visit) const {
    const auto cell = first_.find(key);
    if (cell == first_.end()) return;
    for (std::size_t i = cell->second;; i = next_[i]) {
      visit(i);
      if (next_[i] == i) return;
    }
  }

  float inverse_size_;
  tsl::robin_map<VoxelKey, std::size_t, VoxelKeyHash> first_;
  std::vector<std::size_t> next_;  ///< next index in the same cell; the last one refers to itself
};

}  // namespace mms
