#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/geometry/voxels/voxel_key.hpp"

namespace mms {

/// Compact state of a voxel: position to 1/256 of its side, normal to half a degree.
struct VoxelChange {
  std::uint16_t cell = 0;                ///< index in its block: x + 8 y + 64 z, below 512
  std::uint16_t hits = 0;                ///< observations of the voxel
  std::array<std::uint8_t, 3> offset{};  ///< position of the mean in the voxel [side / 256]
  std::array<std::int8_t, 3> normal{};   ///< unit normal times 127; zero if unknown
  Rgb color{};

  bool operator==(const VoxelChange&) const = default;
};

/// Changes in a cube of 8^3 voxels.
struct BlockChange {
  VoxelKey key;             ///< in units of the block's side
  std::uint16_t views = 0;  ///< observations of the block
  std::uint32_t count = 0;  ///< its voxels in `MapChanges::voxels`, after those of earlier blocks

  bool operator==(const BlockChange&) const = default;
};

/// Changes of a voxel map by one observation, sufficient to repeat it without the points.
struct MapChanges {
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Zero();  ///< of its last frame, world frame [m]
  double voxel_size = 0.0;                              ///< side of a voxel [m]
  bool whole = false;               ///< the blocks are the whole map and replace the present one
  std::vector<BlockChange> blocks;  ///< in order of insertion into the map
  std::vector<VoxelChange> voxels;  ///< of all blocks, in their order
  std::vector<VoxelKey> erased;     ///< removed voxels, in units of a voxel's side

  /// Calls `visit(block, voxels)` for all blocks, with the span of their voxels.
  template <class Visit>
  void for_each_block(const Visit& visit) const {
    std::span<const VoxelChange> rest(voxels);
    for (const BlockChange& block : blocks) {
      const std::size_t count = std::min<std::size_t>(block.count, rest.size());
      visit(block, rest.first(count));
      rest = rest.subspan(count);
    }
  }

  bool operator==(const MapChanges&) const = default;
};

/// A voxel with fewer hits than needed counts as an outlier only if its block has this many times
/// the needed observations: at long range the points of a surface fall into varying voxels, and
/// occluded surfaces are rarely observed.
inline constexpr std::size_t kViewsPerObservation = 5;

/// Whether a voxel is part of the map: it has the `needed` observations, or its block has too few
/// to decide.
/// @param hits observations of the voxel
/// @param views observations of its block
constexpr bool is_voxel_shown(std::size_t hits, std::size_t views, std::size_t needed) {
  return hits >= needed || views <= kViewsPerObservation * needed;
}

}  // namespace mms
