#pragma once

#include <tsl/robin_map.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "mms/geometry/voxels/map_changes.hpp"
#include "mms/geometry/voxels/voxel_key.hpp"
#include "mms/server/scene/scene_data.hpp"

namespace mms {

/// A chunk's points at one level of detail.
struct LevelPoints {
  int level = 0;            ///< 0: voxels of the map; each further level doubles the side
  double voxel_size = 0.0;  ///< side of a voxel at that level [m]
  ColoredPoints cloud;      ///< world frame
};

/// State of a chunk.
struct ChunkState {
  VoxelKey key;                                      ///< in units of the chunk's side
  std::uint64_t version = 0;                         ///< incremented by every change
  std::size_t points = 0;                            ///< at level 0; approximate
  Eigen::Vector3f center = Eigen::Vector3f::Zero();  ///< world frame [m]
};

/// The static map in cubes of kSide^3 voxels, sent to viewers one by one. Applies the changes of
/// the map (MapChanges) and contains the same visible voxels.
class MapChunks {
 public:
  static constexpr int kBlockBits = 3;  ///< a block's side is 8 voxels
  static constexpr int kSideBits = 7;
  static constexpr int kSide = 1 << kSideBits;  ///< voxels
  static constexpr int kLevels = 4;             ///< 0 to 3 (coarsest)

  /// @param min_observations  observations that a voxel needs to be visible
  explicit MapChunks(int min_observations) : min_observations_(min_observations) {}

  /// Applies changes. Ignores voxels with an invalid index.
  void apply(const MapChanges& changes);

  /// The chunks with voxels, by key.
  std::vector<ChunkState> states() const;

  /// The visible points of a chunk, downsampled to means; none for an unknown chunk.
  LevelPoints points(const VoxelKey& chunk, int level) const;

  /// All visible points.
  ColoredPoints cloud() const;

  double voxel_size() const { return voxel_size_; }
  std::uint64_t version() const { return version_; }
  std::size_t size() const { return voxels_; }  ///< voxels, visible or not

 private:
  struct Block {
    std::uint16_t views = 0;
    std::vector<VoxelChange> voxels;  // by cell
  };
  struct Chunk {
    std::uint64_t version = 0;
    std::size_t voxels = 0;
    std::map<VoxelKey, Block> blocks;
  };

  void change(const BlockChange& change, std::span<const VoxelChange> voxels);
  void erase(const VoxelKey& voxel);
  bool is_shown(const Block& block, const VoxelChange& voxel) const;
  template <class Use>
  void for_each_shown(const Chunk& chunk, const Use& use) const;

  int min_observations_;
  double voxel_size_ = 0.0;
  std::uint64_t version_ = 0;
  std::size_t views_ = 0;
  std::size_t voxels_ = 0;
  std::map<VoxelKey, Chunk> chunks_;
};

/// A cloud as changes of an empty map, one point per voxel.
/// @param voxel_size  [m], > 0
MapChanges changes_of(std::span<const Eigen::Vector3f> points, std::span<const Rgb> colors,
                      double voxel_size);

}  // namespace mms
