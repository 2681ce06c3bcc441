#include "mms/io/journal/journal_map.hpp"

#include <cmath>
#include <span>

#include "mms/core/error.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

constexpr std::size_t kVoxelBytes = 13;
constexpr std::size_t kBlockBytes = 18;
constexpr std::size_t kKeyBytes = 12;
constexpr int kCells = 512;  // of a block
constexpr std::int32_t kMaxKey =
    (1 << 28) - 1;  // of a block, so that the keys of its voxels fit 32 bits

void append_key(std::string& bytes, const VoxelKey& key) {
  append_bytes(bytes, key.x);
  append_bytes(bytes, key.y);
  append_bytes(bytes, key.z);
}

VoxelKey take_key(ByteReader& bytes) {
  VoxelKey key;
  key.x = bytes.take<std::int32_t>();
  key.y = bytes.take<std::int32_t>();
  key.z = bytes.take<std::int32_t>();
  return key;
}

void append_voxel(std::string& bytes, const VoxelChange& voxel) {
  append_bytes(bytes, voxel.cell);
  append_bytes(bytes, voxel.hits);
  append_bytes(bytes, voxel.offset);
  append_bytes(bytes, voxel.normal);
  append_bytes(bytes, voxel.color);
}

VoxelChange take_voxel(ByteReader& bytes) {
  VoxelChange voxel;
  voxel.cell = bytes.take<std::uint16_t>();
  voxel.hits = bytes.take<std::uint16_t>();
  voxel.offset = bytes.take<std::array<std::uint8_t, 3>>();
  voxel.normal = bytes.take<std::array<std::int8_t, 3>>();
  voxel.color = bytes.take<Rgb>();
  if (voxel.cell < kCells) return voxel;
  throw DataError(bytes.where(), "a voxel has the index " + std::to_string(voxel.cell) +
                                     " in its block, allowed: 0 to " + std::to_string(kCells - 1));
}

/// Adds a block and its voxels to the changes.
void take_block(ByteReader& bytes, MapChanges& changes) {
  BlockChange block;
  block.key = take_key(bytes);
  for (const std::int32_t side : {block.key.x, block.key.y, block.key.z}) {
    if (side >= -kMaxKey && side <= kMaxKey) continue;
    throw DataError(bytes.where(), "a block is at " + std::to_string(side) +
                                       ", allowed: within +-" + std::to_string(kMaxKey));
  }
  block.views = bytes.take<std::uint16_t>();
  block.count = bytes.take_count(kVoxelBytes);
  changes.blocks.push_back(block);
  for (std::uint32_t i = 0; i < block.count; ++i) changes.voxels.push_back(take_voxel(bytes));
}

}  // namespace

void append_map(std::string& bytes, const MapChanges& changes) {
  bytes.reserve(bytes.size() + kVoxelBytes * changes.voxels.size() +
                kBlockBytes * changes.blocks.size() + kKeyBytes * changes.erased.size());
  for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, changes.viewpoint[axis]);
  append_bytes(bytes, changes.voxel_size);
  append_bytes(bytes, static_cast<std::uint8_t>(changes.whole));
  append_bytes(bytes, static_cast<std::uint32_t>(changes.blocks.size()));
  changes.for_each_block([&](const BlockChange& block, std::span<const VoxelChange> voxels) {
    append_key(bytes, block.key);
    append_bytes(bytes, block.views);
    append_bytes(bytes, block.count);
    for (const VoxelChange& voxel : voxels) append_voxel(bytes, voxel);
  });
  append_bytes(bytes, static_cast<std::uint32_t>(changes.erased.size()));
  for (const VoxelKey& key : changes.erased) append_key(bytes, key);
}

MapChanges take_map(ByteReader& bytes) {
  MapChanges changes;
  for (int axis = 0; axis < 3; ++axis) changes.viewpoint[axis] = bytes.take<float>();
  changes.voxel_size = take_voxel_size(bytes);
  changes.whole = bytes.take<std::uint8_t>() != 0;
  const std::uint32_t blocks = bytes.take_count(kBlockBytes);
  changes.blocks.reserve(blocks);
  for (std::uint32_t i = 0; i < blocks; ++i) take_block(bytes, changes);
  changes.erased.resize(bytes.take_count(kKeyBytes));
  for (VoxelKey& key : changes.erased) key = take_key(bytes);
  return changes;
}

double take_voxel_size(ByteReader& bytes) {
  constexpr double kMaxVoxelSize = 1e6;
  const auto size = bytes.take<double>();
  if (size > 0.0 && size <= kMaxVoxelSize) return size;
  throw DataError(bytes.where(), "the voxel size is " + format_number(size) +
                                     " m, allowed: above 0, at most " +
                                     format_number(kMaxVoxelSize));
}

}  // namespace mms
