#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <string>

#include "mms/core/error.hpp"
#include "mms/mapping/static_map/static_map.hpp"

namespace mms {
namespace {

/// [-]: steps of a position within its voxel. Source: one byte; 0.08 mm in a voxel of 2 cm.
constexpr float kOffsetSteps = 256.0F;

/// [-]: steps of a normal's coordinate. Source: one signed byte; about half a degree.
constexpr float kNormalSteps = 127.0F;

Eigen::Vector3f corner_of(const VoxelKey& key, double voxel_size) {
  return (Eigen::Vector3d(key.x, key.y, key.z) * voxel_size).cast<float>();
}

VoxelChange change_of(const VoxelBlock& block, const Voxel& voxel, double voxel_size) {
  VoxelChange change{voxel.cell, voxel.hits, {}, {}, to_rgb(voxel.color)};
  const Eigen::Vector3f offset = (voxel.position - corner_of(block.voxel_key(voxel), voxel_size)) *
                                 (kOffsetSteps / static_cast<float>(voxel_size));
  const float length = voxel.normal.norm();
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    change.offset[i] = static_cast<std::uint8_t>(std::clamp(offset[axis], 0.0F, 255.0F));
    if (!has_normal(voxel)) continue;
    change.normal[i] =
        static_cast<std::int8_t>(std::lround(kNormalSteps * voxel.normal[axis] / length));
  }
  return change;
}

void apply_change(const VoxelChange& change, const VoxelKey& key, double voxel_size, Voxel& voxel) {
  voxel.hits = change.hits;
  voxel.color = Eigen::Vector3f(change.color.r, change.color.g, change.color.b);
  voxel.position = corner_of(key, voxel_size);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    voxel.position[axis] += (static_cast<float>(change.offset[i]) + 0.5F) *
                            static_cast<float>(voxel_size) / kOffsetSteps;
    voxel.normal[axis] = static_cast<float>(change.normal[i]) / kNormalSteps;
  }
}

/// A mean of n views changes little with the next one, so it is reported again when n has doubled,
/// and when the voxel begins to be shown.
bool is_due(const Voxel& voxel, int min_observations) {
  return std::has_single_bit(voxel.hits) || voxel.hits == min_observations;
}

void check(const VoxelChange& change) {
  if (change.cell < BlockCells::kCount) return;
  throw DataError("map changes", "a voxel is at place " + std::to_string(change.cell) +
                                     " of its block, allowed: 0 to " +
                                     std::to_string(BlockCells::kCount - 1));
}

}  // namespace

MapChanges StaticMap::changes() const {
  MapChanges changes;
  changes.voxel_size = grid_.voxel_size();
  if (views_ == 0) return changes;
  changes.viewpoint = viewpoints_.at(last_view_);
  changes.whole = coarsened_;
  if (!coarsened_) changes.erased = carved_;
  // Further views show the same voxels as those before.
  const auto needed = static_cast<std::size_t>(config_.min_observations);
  const auto add = [&](const VoxelBlock& block) {
    const std::size_t before = changes.voxels.size();
    for (const Voxel& voxel : block.voxels) {
      const bool is_reported =
          voxel.last_frame > previous_view_ && is_due(voxel, config_.min_observations);
      if (coarsened_ || is_reported) {
        changes.voxels.push_back(change_of(block, voxel, grid_.voxel_size()));
      }
    }
    const auto count = static_cast<std::uint32_t>(changes.voxels.size() - before);
    const bool matters = block.views <= kViewsPerObservation * needed + 1;
    if (matters || count > 0) changes.blocks.push_back({block.key, block.views, count});
  };
  if (coarsened_) {
    for (const VoxelBlock& block : grid_.blocks()) add(block);
  } else {
    for (const std::uint32_t index : view_blocks_) add(grid_.blocks()[index]);
  }
  return changes;
}

void StaticMap::apply(const MapChanges& changes) {
  if (changes.whole) grid_ = VoxelGrid(changes.voxel_size);
  viewpoints_.add(changes.viewpoint);
  ++views_;
  last_view_ = last_frame();
  if (viewpoints_.wants_pruning()) prune_viewpoints();
  changes.for_each_block([&](const BlockChange& change, std::span<const VoxelChange> voxels) {
    for (const VoxelChange& voxel_change : voxels) {
      check(voxel_change);
      const VoxelKey key = BlockCells::voxel_of(change.key, voxel_change.cell);
      Voxel& voxel = grid_.place(key).voxel();
      apply_change(voxel_change, key, grid_.voxel_size(), voxel);
      voxel.last_frame = last_view_;
    }
    if (VoxelBlock* block = grid_.find_block(change.key)) block->views = change.views;
  });
  for (const VoxelKey& key : changes.erased) grid_.erase(key);
}

}  // namespace mms
