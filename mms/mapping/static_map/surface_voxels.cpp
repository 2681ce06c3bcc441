#include "mms/mapping/static_map/surface_voxels.hpp"

#include <algorithm>

namespace mms {
namespace {

void merge(const Voxel& from, Voxel& into) {
  const bool first = into.hits == 0;
  into.weight += from.weight;
  const float share = from.weight / into.weight;
  into.position += share * (from.position - into.position);
  into.normal += share * (from.normal - into.normal);
  into.color += share * (from.color - into.color);
  into.hits = std::max(into.hits, from.hits);
  into.seen_through = first ? from.seen_through : std::min(into.seen_through, from.seen_through);
  into.last_frame = std::max(into.last_frame, from.last_frame);
}

}  // namespace

VoxelGrid::VoxelGrid(double voxel_size)
    : voxel_size_(voxel_size), inverse_size_(static_cast<float>(1.0 / voxel_size)) {}

std::size_t VoxelGrid::block_index(const VoxelKey& key) {
  if (last_block_ < blocks_.size() && blocks_[last_block_].key == key) return last_block_;
  const auto [entry, created] = index_.insert({key, static_cast<std::uint32_t>(blocks_.size())});
  if (created) blocks_.emplace_back().key = key;
  return last_block_ = entry->second;
}

VoxelGrid::Place VoxelGrid::place(const VoxelKey& key) {
  VoxelBlock& block = blocks_[block_index(BlockCells::block_of(key))];
  const std::uint16_t cell = BlockCells::cell_of(key);
  if (block.slot[cell] == 0) {
    const std::size_t before = block.voxels.capacity();
    block.voxels.emplace_back().cell = cell;
    block.slot[cell] = static_cast<std::uint16_t>(block.voxels.size());
    capacity_ += block.voxels.capacity() - before;
    ++size_;
  }
  return {&block, block.slot[cell] - 1U};
}

const Voxel* VoxelGrid::find(const VoxelKey& key) const {
  const auto entry = index_.find(BlockCells::block_of(key));
  if (entry == index_.end()) return nullptr;
  const VoxelBlock& block = blocks_[entry->second];
  const std::uint16_t slot = block.slot[BlockCells::cell_of(key)];
  return slot == 0 ? nullptr : &block.voxels[slot - 1U];
}

VoxelBlock* VoxelGrid::find_block(const VoxelKey& key) {
  const auto entry = index_.find(key);
  return entry == index_.end() ? nullptr : &blocks_[entry->second];
}

void VoxelGrid::erase(const VoxelKey& key) {
  VoxelBlock* block = find_block(BlockCells::block_of(key));
  if (block == nullptr) return;
  const std::uint16_t slot = block->slot[BlockCells::cell_of(key)];
  if (slot != 0) erase(*block, slot - 1U);
}

void VoxelGrid::erase(VoxelBlock& block, std::size_t index) {
  block.slot[block.voxels[index].cell] = 0;
  if (index + 1 != block.voxels.size()) {
    block.voxels[index] = block.voxels.back();
    block.slot[block.voxels[index].cell] = static_cast<std::uint16_t>(index + 1);
  }
  block.voxels.pop_back();
  --size_;
}

VoxelGrid VoxelGrid::coarsened() const {
  VoxelGrid coarse(2.0 * voxel_size_);
  for (const VoxelBlock& block : blocks_) {
    for (const Voxel& voxel : block.voxels) {
      const VoxelKey key = block.voxel_key(voxel);
      merge(voxel, coarse.place(VoxelKey{key.x >> 1, key.y >> 1, key.z >> 1}).voxel());
    }
  }
  return coarse;
}

std::size_t VoxelGrid::memory_bytes() const {
  using Entry = std::pair<VoxelKey, std::uint32_t>;
  // [-]: bytes of a bucket. Source: robin_map stores a distance and a hash of 4 bytes each.
  constexpr std::size_t kBucketSize = sizeof(Entry) + 8;
  return blocks_.size() * sizeof(VoxelBlock) + capacity_ * sizeof(Voxel) +
         index_.bucket_count() * kBucketSize;
}

}  // namespace mms
