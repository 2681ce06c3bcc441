#include "mms/mapping/occupancy/occupancy_blocks.hpp"

#include <algorithm>

#include "mms/geometry/voxels/index_bytes.hpp"

namespace mms {

OccupancyBlock& OccupancyBlocks::at(const VoxelKey& key) {
  const auto [entry, created] = index_.insert({key, static_cast<std::uint32_t>(blocks_.size())});
  if (created) blocks_.emplace_back(key);
  return blocks_[entry->second];
}

LogOdds OccupancyBlocks::log_odds(const VoxelKey& key) const {
  const auto entry = index_.find(BlockCells::block_of(key));
  if (entry == index_.end()) return kUnobserved;
  return blocks_[entry->second].log_odds[BlockCells::cell_of(key)];
}

OccupancyBlocks OccupancyBlocks::coarsened() const {
  OccupancyBlocks coarse(2.0 * voxel_size_);
  for (const OccupancyBlock& block : blocks_) {
    OccupancyBlock& into = coarse.at({block.key.x >> 1, block.key.y >> 1, block.key.z >> 1});
    for (int cell = 0; cell < BlockCells::kCount; ++cell) {
      const VoxelKey fine = BlockCells::voxel_of(block.key, cell);
      LogOdds& value = into.log_odds[BlockCells::cell_of({fine.x >> 1, fine.y >> 1, fine.z >> 1})];
      value = std::max(value, block.log_odds[static_cast<std::size_t>(cell)]);
    }
  }
  return coarse;
}

std::size_t OccupancyBlocks::memory_bytes() const {
  return blocks_.size() * sizeof(OccupancyBlock) + index_bytes(index_);
}

}  // namespace mms
