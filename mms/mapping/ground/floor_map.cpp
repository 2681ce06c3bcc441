#include "mms/mapping/ground/floor_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace mms {
namespace {

/// [m]: depth below the floor's plane to which voxels belong to the floor. Source: a plane tilted
/// by one degree is off by 0.3 m at 17 m, about `max_range` of the occupancy map.
constexpr double kMaxFloorDip = 0.3;

/// [-]: cells of a grid. Source: memory; 100 MB of one byte each, a square kilometre of 0.1 m
/// cells.
constexpr std::int64_t kMaxCells = 100'000'000;

/// [-]: voxels from the origin to a point. Source: keys are integers of 32 bits.
constexpr float kMaxVoxels = 1e9F;

/// Calls `visit(key)` for the voxels of the map frame whose centres may lie in the block.
template <class Visit>
void for_each_near(const OccupancyBlock& block, double voxel_size,
                   const Eigen::Isometry3d& T_map_world, const Visit& visit) {
  const Eigen::Array3d corner(block.key.x, block.key.y, block.key.z);
  const Eigen::Vector3d center =
      T_map_world * ((corner + 0.5) * BlockCells::kSide * voxel_size).matrix();
  const Eigen::Array3d reach = T_map_world.linear().cwiseAbs() *
                               Eigen::Vector3d::Constant(0.5 * BlockCells::kSide * voxel_size);
  const Eigen::Array3i low = ((center.array() - reach) / voxel_size - 0.5).ceil().cast<int>();
  const Eigen::Array3i high = ((center.array() + reach) / voxel_size - 0.5).floor().cast<int>();
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) visit(VoxelKey{x, y, z});
    }
  }
}

Eigen::Vector3d center_of(const VoxelKey& key, double voxel_size) {
  return (Eigen::Array3d(key.x, key.y, key.z) + 0.5).matrix() * voxel_size;
}

/// Bounds of the columns of all added voxels.
struct Bounds {
  std::int32_t min_x = std::numeric_limits<std::int32_t>::max();
  std::int32_t min_y = std::numeric_limits<std::int32_t>::max();
  std::int32_t max_x = std::numeric_limits<std::int32_t>::min();
  std::int32_t max_y = std::numeric_limits<std::int32_t>::min();

  void add(const VoxelKey& key) {
    min_x = std::min(min_x, key.x);
    min_y = std::min(min_y, key.y);
    max_x = std::max(max_x, key.x);
    max_y = std::max(max_y, key.y);
  }
  bool empty() const { return min_x > max_x; }
  std::int64_t cells(int bits) const { return width(bits) * height(bits); }
  std::int64_t width(int bits) const { return (max_x >> bits) - (min_x >> bits) + 1; }
  std::int64_t height(int bits) const { return (max_y >> bits) - (min_y >> bits) + 1; }
};

/// State that a voxel gives to the grid cell below it.
class CellState {
 public:
  CellState(double voxel_size, const GridConfig& config) : size_(voxel_size), config_(config) {}

  Occupancy of(const VoxelKey& key, Occupancy state) const {
    const double height = (key.z + 0.5) * size_;
    // The layers on both sides of the plane hold the floor, whatever their height.
    if (height < -std::max(kMaxFloorDip, size_)) return Occupancy::kUnknown;
    if (state == Occupancy::kFree) {
      return height < std::max(config_.free_height, size_) ? Occupancy::kFree : Occupancy::kUnknown;
    }
    if (height < std::max(config_.min_height, size_)) return Occupancy::kFree;
    return height < config_.max_height ? Occupancy::kOccupied : Occupancy::kUnknown;
  }

 private:
  double size_;
  GridConfig config_;
};

/// Whether none of the 26 voxels around one is an obstacle: noise, or points of a person's shoe.
/// Obstacles have neighbours, a pole above and below. The floor does not count as one.
bool is_isolated(const std::vector<VoxelKey>& obstacles, const VoxelKey& key) {
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      const auto first = std::lower_bound(obstacles.begin(), obstacles.end(),
                                          VoxelKey{key.x + x, key.y + y, key.z - 1});
      for (auto next = first; next != obstacles.end(); ++next) {
        if (*next > VoxelKey{key.x + x, key.y + y, key.z + 1}) break;
        if (*next != key) return false;
      }
    }
  }
  return true;
}

template <class Visit>
void for_each_cell_state(const OccupancyVoxels& voxels, const GridConfig& config,
                         const Visit& visit) {
  const CellState state_of_cell(voxels.voxel_size, config);
  std::vector<VoxelKey> obstacles;
  for (const VoxelKey& key : voxels.free) {
    if (state_of_cell.of(key, Occupancy::kFree) == Occupancy::kFree) visit(key, Occupancy::kFree);
  }
  for (const VoxelKey& key : voxels.occupied) {
    const Occupancy result = state_of_cell.of(key, Occupancy::kOccupied);
    if (result == Occupancy::kFree) visit(key, result);
    if (result == Occupancy::kOccupied) obstacles.push_back(key);
  }
  for (const VoxelKey& key : obstacles) {
    if (!is_isolated(obstacles, key)) visit(key, Occupancy::kOccupied);
  }
}

}  // namespace

OccupancyVoxels voxels_in_map_frame(const OccupancyMap& map,
                                    const Transform<World, Map>& T_world_map) {
  const double size = map.voxel_size();
  const Eigen::Isometry3d T_map_world = T_world_map.isometry().inverse();
  OccupancyVoxels voxels{size, {}, {}};
  for (const OccupancyBlock& block : map.blocks().all()) {
    for_each_near(block, size, T_map_world, [&](const VoxelKey& key) {
      const Eigen::Vector3d center = T_world_map * center_of(key, size);
      const VoxelKey source = voxel_key(center.cast<float>(), static_cast<float>(1.0 / size));
      if (BlockCells::block_of(source) != block.key) return;
      const Occupancy state = occupancy_of(block.log_odds[BlockCells::cell_of(source)]);
      if (state == Occupancy::kOccupied) voxels.occupied.push_back(key);
      if (state == Occupancy::kFree) voxels.free.push_back(key);
    });
  }
  std::sort(voxels.occupied.begin(), voxels.occupied.end());
  std::sort(voxels.free.begin(), voxels.free.end());
  return voxels;
}

namespace {

/// Voxels of points, sorted.
std::vector<VoxelKey> voxels_of(const std::vector<Eigen::Vector3f>& points,
                                const Transform<World, Map>& T_world_map, double voxel_size) {
  const Eigen::Isometry3f T_map_world = T_world_map.isometry().inverse().cast<float>();
  const auto inverse_size = static_cast<float>(1.0 / voxel_size);
  std::vector<VoxelKey> keys;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3f in_map = T_map_world * point;
    if (!in_map.allFinite() || inverse_size * in_map.cwiseAbs().maxCoeff() > kMaxVoxels) continue;
    keys.push_back(voxel_key(in_map, inverse_size));
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

/// Moves what is in `keys` from one sorted set to another.
void move_voxels(const std::vector<VoxelKey>& keys, std::vector<VoxelKey>& from,
                 std::vector<VoxelKey>& to) {
  std::vector<VoxelKey> kept;
  std::vector<VoxelKey> joined;
  std::set_difference(from.begin(), from.end(), keys.begin(), keys.end(), std::back_inserter(kept));
  std::set_union(to.begin(), to.end(), keys.begin(), keys.end(), std::back_inserter(joined));
  from = std::move(kept);
  to = std::move(joined);
}

}  // namespace

void add_occupied(const std::vector<Eigen::Vector3f>& points,
                  const Transform<World, Map>& T_world_map, OccupancyVoxels& voxels) {
  move_voxels(voxels_of(points, T_world_map, voxels.voxel_size), voxels.free, voxels.occupied);
}

void remove_occupied(const std::vector<Eigen::Vector3f>& points,
                     const Transform<World, Map>& T_world_map, OccupancyVoxels& voxels) {
  std::vector<VoxelKey> keys = voxels_of(points, T_world_map, voxels.voxel_size);
  std::erase_if(keys, [&](const VoxelKey& key) {
    return !std::binary_search(voxels.occupied.begin(), voxels.occupied.end(), key);
  });
  move_voxels(keys, voxels.occupied, voxels.free);
}

OccupancyGrid floor_grid(const OccupancyVoxels& voxels, const Transform<World, Map>& T_world_map,
                         const GridConfig& config) {
  Bounds bounds;
  for_each_cell_state(voxels, config, [&](const VoxelKey& key, Occupancy) { bounds.add(key); });
  int bits = 0;  // a cell has 2^bits voxels a side
  while (!bounds.empty() && bounds.cells(bits) > kMaxCells) ++bits;
  OccupancyGrid grid;
  grid.resolution = voxels.voxel_size * (1 << bits);
  grid.T_world_map = T_world_map;
  if (bounds.empty()) return grid;
  const std::int32_t left = bounds.min_x >> bits;
  const std::int32_t bottom = bounds.min_y >> bits;
  grid.origin = grid.resolution * Eigen::Vector2d(left, bottom);
  grid.cells = Image<Occupancy>(static_cast<int>(bounds.width(bits)),
                                static_cast<int>(bounds.height(bits)), Occupancy::kUnknown);
  for_each_cell_state(voxels, config, [&](const VoxelKey& key, Occupancy state) {
    Occupancy& cell = grid.cells((key.x >> bits) - left, (key.y >> bits) - bottom);
    cell = std::max(cell, state);
  });
  return grid;
}

}  // namespace mms
