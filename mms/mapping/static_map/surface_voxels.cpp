#include "mms/mapping/static_map/surface_voxels.hpp"

#include <algorithm>

#include "mms/geometry/voxels/index_bytes.hpp"

namespace mms {
namespace {

/// [-]: most voxels of a block that are searched one by one. Source: a table of slots has the
/// memory of twenty voxels; distant blocks of a LiDAR's map have one or two.
constexpr std::size_t kMaxListed = 12;

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
  if (created) {
    blocks_.emplace_back().key = key;
    add_to_region(key, entry->second);
  }
  return last_block_ = entry->second;
}

void VoxelGrid::add_to_region(const VoxelKey& block, std::uint32_t index) {
  const VoxelKey key{block.x >> kRegionBits, block.y >> kRegionBits, block.z >> kRegionBits};
  const auto [entry, created] =
      region_index_.insert({key, static_cast<std::uint32_t>(regions_.size())});
  if (created) regions_.push_back({key, {}});
  regions_[entry->second].blocks.push_back(index);
}

void VoxelGrid::make_slots(VoxelBlock& block) {
  block.slots = std::make_unique<VoxelBlock::Slots>();
  for (std::size_t i = 0; i < block.voxels.size(); ++i) {
    (*block.slots)[block.voxels[i].cell] = static_cast<std::uint16_t>(i + 1);
  }
  ++slots_;
}

VoxelGrid::Place VoxelGrid::place(const VoxelKey& key) {
  const std::size_t at = block_index(BlockCells::block_of(key));
  VoxelBlock& block = blocks_[at];
  const std::uint16_t cell = BlockCells::cell_of(key);
  const std::size_t index = block.index_of(cell);
  if (index == block.voxels.size()) {
    const std::size_t before = block.voxels.capacity();
    block.voxels.emplace_back().cell = cell;
    if (block.slots) (*block.slots)[cell] = static_cast<std::uint16_t>(index + 1);
    if (!block.slots && block.voxels.size() > kMaxListed) make_slots(block);
    capacity_ += block.voxels.capacity() - before;
    ++size_;
  }
  return {&block, at, index};
}

const Voxel* VoxelGrid::find(const VoxelKey& key) const {
  const auto entry = index_.find(BlockCells::block_of(key));
  if (entry == index_.end()) return nullptr;
  const VoxelBlock& block = blocks_[entry->second];
  const std::size_t index = block.index_of(BlockCells::cell_of(key));
  return index == block.voxels.size() ? nullptr : &block.voxels[index];
}

VoxelBlock* VoxelGrid::find_block(const VoxelKey& key) {
  const auto entry = index_.find(key);
  return entry == index_.end() ? nullptr : &blocks_[entry->second];
}

void VoxelGrid::erase(const VoxelKey& key) {
  VoxelBlock* block = find_block(BlockCells::block_of(key));
  if (block == nullptr) return;
  const std::size_t index = block->index_of(BlockCells::cell_of(key));
  if (index != block->voxels.size()) erase(*block, index);
}

void VoxelGrid::erase(VoxelBlock& block, std::size_t index) {
  const auto set_slot = [&](std::uint16_t cell, std::size_t slot) {
    if (block.slots) (*block.slots)[cell] = static_cast<std::uint16_t>(slot);
  };
  set_slot(block.voxels[index].cell, 0);
  if (index + 1 != block.voxels.size()) {
    block.voxels[index] = block.voxels.back();
    set_slot(block.voxels[index].cell, index + 1);
  }
  block.voxels.pop_back();
  --size_;
}

VoxelGrid VoxelGrid::coarsened(bool keeps_views) const {
  VoxelGrid coarse(2.0 * voxel_size_);
  for (const VoxelBlock& block : blocks_) {
    for (const Voxel& voxel : block.voxels) {
      const VoxelKey key = block.voxel_key(voxel);
      const Place place = coarse.place(VoxelKey{key.x >> 1, key.y >> 1, key.z >> 1});
      merge(voxel, place.voxel());
      if (!keeps_views) continue;
      place.block->views = std::max(place.block->views, block.views);
      place.block->last_frame = std::max(place.block->last_frame, block.last_frame);
    }
  }
  return coarse;
}

std::size_t VoxelGrid::memory_bytes() const {
  return blocks_.size() * (sizeof(VoxelBlock) + sizeof(std::uint32_t)) +
         slots_ * sizeof(VoxelBlock::Slots) + capacity_ * sizeof(Voxel) + index_bytes(index_);
}

}  // namespace mms
