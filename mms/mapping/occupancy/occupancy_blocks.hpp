#pragma once

#include <tsl/robin_map.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "mms/geometry/voxels/block_cells.hpp"
#include "mms/geometry/voxels/occupancy.hpp"

namespace mms {

/// Log odds that a voxel is occupied, in steps of 1 / kLogOddsScale.
using LogOdds = std::int8_t;

/// [-]: steps of log odds. Source: the byte's range of +-127 covers probabilities to 0.998.
constexpr float kLogOddsScale = 20.0F;

/// [-]: value of voxels that were never observed. Source: the byte's value beyond -127.
constexpr LogOdds kUnobserved = -128;

inline Occupancy occupancy_of(LogOdds value) {
  if (value == kUnobserved) return Occupancy::kUnknown;
  return value < 0 ? Occupancy::kFree : Occupancy::kOccupied;
}

/// A cube of voxels, stored densely, because most of what a sensor sees is empty space.
struct OccupancyBlock {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): filled below
  explicit OccupancyBlock(const VoxelKey& at) : key(at) { log_odds.fill(kUnobserved); }

  VoxelKey key;  ///< in units of the block's side
  std::array<LogOdds, BlockCells::kCount> log_odds;
  std::uint32_t touched = 0;  ///< number of the last keyframe that looked into it
  std::uint32_t marks = 0;    ///< place of that keyframe's marks
};

/// Storage of the occupancy map: hashed blocks in the order of their creation.
class OccupancyBlocks {
 public:
  /// @param voxel_size  side of a voxel [m]
  explicit OccupancyBlocks(double voxel_size) : voxel_size_(voxel_size) {}

  /// The block at `key` (in units of its side), made where there is none; valid for good.
  OccupancyBlock& at(const VoxelKey& key);

  /// Log odds of the voxel at `key` (in units of its side).
  LogOdds log_odds(const VoxelKey& key) const;

  /// The same space in voxels of twice the side, each as occupied as the most occupied of its
  /// eight.
  OccupancyBlocks coarsened() const;

  const std::deque<OccupancyBlock>& all() const { return blocks_; }
  double voxel_size() const { return voxel_size_; }
  std::size_t memory_bytes() const;

 private:
  double voxel_size_;
  std::deque<OccupancyBlock> blocks_;
  tsl::robin_map<VoxelKey, std::uint32_t, VoxelKeyHash> index_;
};

}  // namespace mms
