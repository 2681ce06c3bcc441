#include "mms/server/scene/map_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mms {
namespace {

constexpr float kOffsetSteps = 256.0F;
constexpr int kBlockSide = 1 << MapChunks::kBlockBits;
constexpr int kBlockMask = kBlockSide - 1;
constexpr int kBlockCells = kBlockSide * kBlockSide * kBlockSide;
constexpr Rgb kUncoloredVoxel{128, 128, 128};
/// Observations of a point that a whole map shows: it stays, however often its block is seen later.
constexpr std::uint16_t kShownHits = std::numeric_limits<std::uint16_t>::max();
/// Largest distance of a valid point from the origin [voxels]: keys have 32 bits.
constexpr float kMaxVoxels = 1e9F;

VoxelKey chunk_of_block(const VoxelKey& block) {
  constexpr int kBits = MapChunks::kSideBits - MapChunks::kBlockBits;
  return {block.x >> kBits, block.y >> kBits, block.z >> kBits};
}

VoxelKey block_of(const VoxelKey& voxel) {
  return {voxel.x >> MapChunks::kBlockBits, voxel.y >> MapChunks::kBlockBits,
          voxel.z >> MapChunks::kBlockBits};
}

std::uint16_t cell_of(const VoxelKey& voxel) {
  return static_cast<std::uint16_t>((voxel.x & kBlockMask) |
                                    (voxel.y & kBlockMask) << MapChunks::kBlockBits |
                                    (voxel.z & kBlockMask) << (2 * MapChunks::kBlockBits));
}

VoxelKey voxel_of(const VoxelKey& block, std::uint16_t cell) {
  return {block.x * kBlockSide + (cell & kBlockMask),
          block.y * kBlockSide + ((cell >> MapChunks::kBlockBits) & kBlockMask),
          block.z * kBlockSide + (cell >> (2 * MapChunks::kBlockBits))};
}

Eigen::Vector3f position_of(const VoxelKey& voxel, const VoxelChange& change, double voxel_size) {
  const Eigen::Vector3d steps(voxel.x + (change.offset[0] + 0.5) / kOffsetSteps,
                              voxel.y + (change.offset[1] + 0.5) / kOffsetSteps,
                              voxel.z + (change.offset[2] + 0.5) / kOffsetSteps);
  return (steps * voxel_size).cast<float>();
}

auto place_of(std::vector<VoxelChange>& voxels, std::uint16_t cell) {
  return std::lower_bound(
      voxels.begin(), voxels.end(), cell,
      [](const VoxelChange& voxel, std::uint16_t target) { return voxel.cell < target; });
}

/// Means of the points per cell of a coarser grid within one chunk.
class CellMeans {
 public:
  explicit CellMeans(int level)
      : level_(level),
        bits_(MapChunks::kSideBits - level),
        slot_(std::size_t{1} << (3 * bits_), 0) {}

  void add(const VoxelKey& voxel, const Eigen::Vector3f& point, const Rgb& color) {
    std::uint32_t& slot = slot_[index(voxel)];
    if (slot == 0) {
      sums_.emplace_back();
      slot = static_cast<std::uint32_t>(sums_.size());
    }
    Sum& sum = sums_[slot - 1];
    sum.point += point;
    sum.color += Eigen::Vector3f(color.r, color.g, color.b);
    sum.count += 1.0F;
  }

  ColoredPoints finish() const {
    ColoredPoints cloud;
    for (const Sum& sum : sums_) {
      cloud.points.push_back(sum.point / sum.count);
      const Eigen::Vector3f c = sum.color / sum.count + Eigen::Vector3f::Constant(0.5F);
      cloud.colors.push_back({static_cast<std::uint8_t>(c.x()), static_cast<std::uint8_t>(c.y()),
                              static_cast<std::uint8_t>(c.z())});
    }
    return cloud;
  }

 private:
  struct Sum {
    Eigen::Vector3f point = Eigen::Vector3f::Zero();
    Eigen::Vector3f color = Eigen::Vector3f::Zero();
    float count = 0.0F;
  };

  std::size_t index(const VoxelKey& voxel) const {
    constexpr int kMask = MapChunks::kSide - 1;
    const auto x = static_cast<std::size_t>((voxel.x & kMask) >> level_);
    const auto y = static_cast<std::size_t>((voxel.y & kMask) >> level_);
    const auto z = static_cast<std::size_t>((voxel.z & kMask) >> level_);
    return x | y << bits_ | z << (2 * bits_);
  }

  int level_;
  int bits_;
  std::vector<std::uint32_t> slot_;  // 1 + index into sums_
  std::vector<Sum> sums_;
};

}  // namespace

void MapChunks::apply(const MapChanges& changes) {
  ++version_;
  ++views_;
  if (changes.whole || changes.voxel_size != voxel_size_) {
    chunks_.clear();
    voxels_ = 0;
  }
  voxel_size_ = changes.voxel_size;
  changes.for_each_block([&](const BlockChange& block, std::span<const VoxelChange> voxels) {
    change(block, voxels);
  });
  for (const VoxelKey& voxel : changes.erased) erase(voxel);
}

void MapChunks::change(const BlockChange& change, std::span<const VoxelChange> voxels) {
  Chunk& chunk = chunks_[chunk_of_block(change.key)];
  Block& block = chunk.blocks[change.key];
  chunk.version = version_;
  block.views = change.views;
  for (const VoxelChange& voxel : voxels) {
    if (voxel.cell >= kBlockCells) continue;
    const auto place = place_of(block.voxels, voxel.cell);
    if (place != block.voxels.end() && place->cell == voxel.cell) {
      *place = voxel;
      continue;
    }
    block.voxels.insert(place, voxel);
    ++chunk.voxels;
    ++voxels_;
  }
}

void MapChunks::erase(const VoxelKey& voxel) {
  const VoxelKey key = block_of(voxel);
  const auto chunk = chunks_.find(chunk_of_block(key));
  if (chunk == chunks_.end()) return;
  const auto block = chunk->second.blocks.find(key);
  if (block == chunk->second.blocks.end()) return;
  const auto place = place_of(block->second.voxels, cell_of(voxel));
  if (place == block->second.voxels.end() || place->cell != cell_of(voxel)) return;
  block->second.voxels.erase(place);
  chunk->second.version = version_;
  --chunk->second.voxels;
  --voxels_;
}

bool MapChunks::is_shown(const Block& block, const VoxelChange& voxel) const {
  const std::size_t needed = std::min(static_cast<std::size_t>(min_observations_), views_);
  return is_voxel_shown(voxel.hits, block.views, needed);
}

template <class Use>
void MapChunks::for_each_shown(const Chunk& chunk, const Use& use) const {
  for (const auto& [key, block] : chunk.blocks) {
    for (const VoxelChange& voxel : block.voxels) {
      if (!is_shown(block, voxel)) continue;
      const VoxelKey place = voxel_of(key, voxel.cell);
      use(place, position_of(place, voxel, voxel_size_), voxel.color);
    }
  }
}

std::vector<ChunkState> MapChunks::states() const {
  const auto side = static_cast<float>(voxel_size_ * kSide);
  std::vector<ChunkState> states;
  states.reserve(chunks_.size());
  for (const auto& [key, chunk] : chunks_) {
    const Eigen::Vector3f corner(static_cast<float>(key.x), static_cast<float>(key.y),
                                 static_cast<float>(key.z));
    if (chunk.voxels == 0) continue;
    states.push_back(
        {key, chunk.version, chunk.voxels, (corner + Eigen::Vector3f::Constant(0.5F)) * side});
  }
  return states;
}

LevelPoints MapChunks::points(const VoxelKey& chunk, int level) const {
  LevelPoints result{level, voxel_size_ * (1 << level), {}};
  const auto found = chunks_.find(chunk);
  if (found == chunks_.end()) return result;
  if (level == 0) {
    for_each_shown(found->second, [&](const VoxelKey&, const Eigen::Vector3f& point, const Rgb& c) {
      result.cloud.points.push_back(point);
      result.cloud.colors.push_back(c);
    });
    return result;
  }
  CellMeans means(level);
  for_each_shown(found->second, [&](const VoxelKey& voxel, const Eigen::Vector3f& point,
                                    const Rgb& color) { means.add(voxel, point, color); });
  result.cloud = means.finish();
  return result;
}

ColoredPoints MapChunks::cloud() const {
  ColoredPoints all;
  for (const auto& [key, chunk] : chunks_) {
    for_each_shown(chunk, [&](const VoxelKey&, const Eigen::Vector3f& point, const Rgb& color) {
      all.points.push_back(point);
      all.colors.push_back(color);
    });
  }
  return all;
}

MapChanges changes_of(std::span<const Eigen::Vector3f> points, std::span<const Rgb> colors,
                      double voxel_size) {
  MapChanges changes;
  changes.voxel_size = voxel_size;
  changes.whole = true;
  const auto inverse = static_cast<float>(1.0 / voxel_size);
  tsl::robin_map<VoxelKey, std::size_t, VoxelKeyHash> place;
  std::vector<std::vector<VoxelChange>> voxels_of_block;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f steps = points[i] * inverse;
    if (!steps.allFinite() || steps.cwiseAbs().maxCoeff() > kMaxVoxels) continue;
    const VoxelKey voxel = voxel_key(points[i], inverse);
    const VoxelKey key = block_of(voxel);
    const auto [found, added] = place.try_emplace(key, changes.blocks.size());
    if (added) {
      changes.blocks.push_back({key, 1, 0});
      voxels_of_block.emplace_back();
    }
    VoxelChange change{
        cell_of(voxel), kShownHits, {}, {}, i < colors.size() ? colors[i] : kUncoloredVoxel};
    for (int axis = 0; axis < 3; ++axis) {
      const float part = (steps[axis] - std::floor(steps[axis])) * kOffsetSteps;
      change.offset[static_cast<std::size_t>(axis)] =
          static_cast<std::uint8_t>(std::clamp(part, 0.0F, kOffsetSteps - 1.0F));
    }
    ++changes.blocks[found->second].count;
    voxels_of_block[found->second].push_back(change);
  }
  for (const std::vector<VoxelChange>& voxels : voxels_of_block) {
    changes.voxels.insert(changes.voxels.end(), voxels.begin(), voxels.end());
  }
  return changes;
}

}  // namespace mms
