#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/geometry/voxels/voxel_key.hpp"

namespace mms {

/// A voxel's state as small as it can be told: position to 1/256 of its side, normal to half a
/// degree.
struct VoxelChange {
  std::uint16_t cell = 0;                ///< place in its block: x + 8 y + 64 z, below 512
  std::uint16_t hits = 0;                ///< views that measured it
  std::array<std::uint8_t, 3> offset{};  ///< mean's place in the voxel [side / 256]
  std::array<std::int8_t, 3> normal{};   ///< unit normal times 127; zero if unknown
  Rgb color{};

  bool operator==(const VoxelChange&) const = default;
};

/// What changed in a cube of 8^3 voxels.
struct BlockChange {
  VoxelKey key;             ///< in units of the block's side
  std::uint16_t views = 0;  ///< views that measured in it
  std::vector<VoxelChange> voxels;

  bool operator==(const BlockChange&) const = default;
};

/// What one view did to a voxel map: enough to repeat it without the points.
struct MapChanges {
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Zero();  ///< of its last frame, world frame [m]
  double voxel_size = 0.0;                              ///< side of a voxel [m]
  bool whole = false;               ///< the blocks are the whole map and replace what there was
  std::vector<BlockChange> blocks;  ///< in the order in which they came into the map
  std::vector<VoxelKey> erased;     ///< voxels that are gone, in units of a voxel's side

  bool operator==(const MapChanges&) const = default;
};

/// How many times as many views as are needed a block has to have before what fewer saw is
/// taken for a stray point. Far away the points of a surface fall now into one voxel, now into the
/// next, and what people hide is seen seldom.
inline constexpr std::size_t kViewsPerObservation = 5;

/// Whether a voxel map shows a voxel: `needed` views measured it, or too few looked at its block to
/// tell.
/// @param hits   views that measured the voxel
/// @param views  views that measured in its block
constexpr bool is_voxel_shown(std::size_t hits, std::size_t views, std::size_t needed) {
  return hits >= needed || views <= kViewsPerObservation * needed;
}

}  // namespace mms
