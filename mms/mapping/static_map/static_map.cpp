#include "mms/mapping/static_map/static_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "mms/core/upper_median.hpp"
#include "mms/geometry/parallel.hpp"
#include "mms/mapping/static_map/sparse_normals.hpp"
#include "mms/mapping/static_map/voxel_normals.hpp"

namespace mms {
namespace {

/// [-]: voxels looked up together, so that their memory loads overlap. Source: halved the time of
/// inserting into a map of more than the cache.
constexpr std::size_t kBatchSize = 32;

/// [-]: share of a block's side that is the depth noise up to which views are counted. Source: with
/// more noise a surface falls into different blocks from view to view.
constexpr double kMaxNoiseShare = 0.5;

/// [-]: hits of a voxel from which on more do not make it harder to remove. Source: ten seconds of
/// keyframes of a camera at rest; as the occupancy map, which is clamped so that it learns changes.
constexpr std::uint16_t kMaxHits = 50;

/// [-]: the same of scans, all hits. Source: the ratio of their carving was chosen with all hits.
constexpr std::uint16_t kUnbounded = std::numeric_limits<std::uint16_t>::max();

/// [-]: share of the memory budget used before voxels are coarsened. Source: the coarser copy is
/// built beside the finer map and has about a third of its memory.
constexpr double kMaxMemoryShare = 0.75;

/// [s]: age of the oldest scan that is asked whether it saw through a point. Source: as of motion
/// segmentation (`MotionSegmentationConfig`): what stays for longer is static.
constexpr double kSightMemory = 3.0;

/// [s]: time between these scans. Source: as `kSightMemory`; six of them have 19 MB.
constexpr double kSightInterval = 0.5;

/// [-]: scans that must have seen through a point that is left out. Source: by experiment on 4 s of
/// the scene warehouse_loop; with one, 0.9 % of the static points of `lidar16` are left out, with
/// two 0.3 %, and 39 instead of 43 % of those on people and vehicles.
constexpr int kMinSights = 2;

/// [-]: points of one parallel task. Source: a tenth of a millisecond, long against the task's
/// start.
constexpr std::size_t kSightChunk = 1024;

void increment(std::uint16_t& counter) {
  if (counter < std::numeric_limits<std::uint16_t>::max()) ++counter;
}

/// Adds a point to the voxel's means.
void average_in(const SurfacePoint& surface, const Eigen::Isometry3f& T_world_sensor,
                Voxel& voxel) {
  voxel.weight += surface.weight;
  const float share = surface.weight / voxel.weight;
  const Eigen::Vector3f color(surface.color.r, surface.color.g, surface.color.b);
  voxel.position += share * (T_world_sensor * surface.point - voxel.position);
  voxel.normal += share * (T_world_sensor.linear() * surface.normal - voxel.normal);
  voxel.color += share * (color - voxel.color);
}

}  // namespace

StaticMap::StaticMap(const StaticMapConfig& config)
    : config_(config), grid_(config.voxel_size), recent_(kSightMemory, kSightInterval) {}

std::size_t StaticMap::add(const LabeledCloud& cloud,
                           const Transform<World, Sensor>& T_world_sensor) {
  if (!T_world_sensor.is_finite()) return 0;
  const Eigen::Isometry3f T = T_world_sensor.isometry().cast<float>();
  is_scan_ = !cloud.organised();
  if (last_frame() == 0 && is_scan_) choose_voxel_size(cloud);
  viewpoints_.add(T.translation(), cloud.stamp);
  std::vector<SurfacePoint> points = surface_points(cloud, config_.surface);
  if (is_scan_) leave_out_arrivals(cloud.stamp, T_world_sensor, points);
  insert(points, T, is_scan_ ? kUnbounded : kMaxHits);
  return points.size();
}

MapUpdate StaticMap::integrate(const LabeledCloud& cloud,
                               const Transform<World, Sensor>& T_world_sensor) {
  MapUpdate update;
  if (!T_world_sensor.is_finite()) return update;
  update.points = add(cloud, T_world_sensor);
  carved_.clear();
  if (config_.carving.enabled) update.carved = carve(cloud, T_world_sensor);
  count_view();
  update.coarsened = coarsened_;
  return update;
}

bool StaticMap::finalize() {
  if (last_view_ == last_frame()) return false;
  carved_.clear();
  count_view();
  return true;
}

void StaticMap::count_view() {
  view_blocks_ = std::exchange(measured_, {});
  std::sort(view_blocks_.begin(), view_blocks_.end());
  const bool is_resized = std::exchange(is_resized_, false);
  coarsened_ = keep_to_budget() || is_resized;
  ++views_;
  previous_view_ = std::exchange(last_view_, last_frame());
  if (viewpoints_.wants_pruning()) prune_viewpoints();
}

void StaticMap::prune_viewpoints() {
  std::vector<bool> is_needed(std::size_t{last_frame()} + 1);
  is_needed[last_view_] = true;
  for (const VoxelBlock& block : grid_.blocks()) {
    for (const Voxel& voxel : block.voxels) is_needed[voxel.last_frame] = true;
  }
  viewpoints_.prune(is_needed);
}

void StaticMap::choose_voxel_size(const LabeledCloud& first_scan) {
  std::vector<float> ranges;
  for (std::size_t i = 0; i < first_scan.points.size(); ++i) {
    if (first_scan.labels[i] == PointLabel::kStatic) ranges.push_back(first_scan.points[i].norm());
  }
  if (ranges.empty()) return;
  const double least =
      config_.scan_voxel_share * static_cast<double>(upper_median(std::move(ranges)));
  if (!(least > grid_.voxel_size())) return;
  grid_ = VoxelGrid(least);
  is_resized_ = true;
}

void StaticMap::leave_out_arrivals(Timestamp stamp, const Transform<World, Sensor>& T_world_sensor,
                                   std::vector<SurfacePoint>& points) const {
  if (recent_.empty()) return;
  const FreeSpaceHistory<ScanSight>::Query scans = recent_.query(stamp, T_world_sensor);
  std::vector<std::uint8_t> is_arrival(points.size());
  parallel_chunks(points.size(), kSightChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      int seen_through = 0;
      scans.for_each(points[i].point, [&](const ScanSight& sight, const Eigen::Vector3f& there) {
        if (sight.sees_through(there)) ++seen_through;
      });
      is_arrival[i] = seen_through >= kMinSights ? 1 : 0;
    }
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_arrival[i] == 0) points[kept++] = points[i];
  }
  points.resize(kept);
}

void StaticMap::insert(const std::vector<SurfacePoint>& points,
                       const Eigen::Isometry3f& T_world_sensor, std::uint16_t max_hits) {
  const float sharp =
      std::min(1.0F, noise_weight(static_cast<float>(kMaxNoiseShare * grid_.block_size()),
                                  config_.surface.noise.depth));
  const auto is_first_view = [&](std::uint32_t& frame) {
    return std::exchange(frame, last_frame()) <= last_view_;
  };
  std::array<VoxelGrid::Place, kBatchSize> places;
  for (std::size_t begin = 0; begin < points.size(); begin += kBatchSize) {
    const std::size_t size = std::min(kBatchSize, points.size() - begin);
    for (std::size_t i = 0; i < size; ++i) {
      places[i] = grid_.place(Eigen::Vector3f(T_world_sensor * points[begin + i].point));
      __builtin_prefetch(&places[i].voxel());
      __builtin_prefetch(&places[i].voxel().cell);
    }
    for (std::size_t i = 0; i < size; ++i) {
      const SurfacePoint& point = points[begin + i];
      VoxelBlock& block = *places[i].block;
      Voxel& voxel = places[i].voxel();
      if (block.last_frame <= last_view_) {
        measured_.push_back(static_cast<std::uint32_t>(places[i].block_index));
      }
      if (is_first_view(block.last_frame) && point.weight >= sharp) increment(block.views);
      if (is_first_view(voxel.last_frame)) {
        increment(voxel.hits);
        if (voxel.hits > max_hits && voxel.seen_through > 0) --voxel.seen_through;
      }
      average_in(point, T_world_sensor, voxel);
    }
  }
}

std::size_t StaticMap::carve(const LabeledCloud& cloud,
                             const Transform<World, Sensor>& T_world_sensor) {
  const CarvingConfig& carving = config_.carving;
  const Eigen::Isometry3f T_sensor_world = T_world_sensor.isometry().cast<float>().inverse();
  if (cloud.organised()) {
    const FreeSpace free_space(cloud, carving.margin, config_.surface.noise.depth);
    return carve(free_space, carving.ratio, kMaxHits, T_sensor_world);
  }
  ScanSight sight(cloud, carving.scan_margin);
  const std::size_t carved = carve(sight, carving.scan_ratio, kUnbounded, T_sensor_world);
  if (recent_.wants(cloud.stamp)) recent_.add(cloud.stamp, std::move(sight), T_world_sensor);
  return carved;
}

template <class Space>
std::size_t StaticMap::carve(const Space& free_space, double views_per_hit, std::uint16_t max_hits,
                             const Eigen::Isometry3f& T_sensor_world) {
  const auto ratio = static_cast<float>(views_per_hit);
  const auto side = static_cast<float>(grid_.block_size());
  const auto gone = [&](Voxel& voxel) {
    if (voxel.last_frame == last_frame()) return false;
    if (!free_space.sees_through(T_sensor_world * voxel.position)) return false;
    increment(voxel.seen_through);
    return static_cast<float>(voxel.seen_through) >
           ratio * static_cast<float>(std::min(voxel.hits, max_hits));
  };
  const auto may_see_into = [&](const Eigen::Vector3f& center, float radius) {
    return free_space.may_see_into(T_sensor_world * center, radius);
  };
  grid_.for_each_block(may_see_into, [&](VoxelBlock& block) {
    const Eigen::Vector3f corner(static_cast<float>(block.key.x), static_cast<float>(block.key.y),
                                 static_cast<float>(block.key.z));
    const Eigen::Vector3f center = (corner.array() + 0.5F).matrix() * side;
    if (!may_see_into(center, kHalfDiagonal * side)) return;
    grid_.erase_if(block, [&](Voxel& voxel) {
      if (!gone(voxel)) return false;
      carved_.push_back(block.voxel_key(voxel));
      return true;
    });
  });
  return carved_.size();
}

bool StaticMap::keep_to_budget() {
  const double limit = kMaxMemoryShare * config_.memory * 1e6;
  bool coarsened = false;
  while (static_cast<double>(grid_.memory_bytes()) > limit && grid_.blocks().size() > 1) {
    // With the views of scans, `lidar16` lost 4.5 points of SA.
    grid_ = grid_.coarsened(!is_scan_);
    coarsened = true;
  }
  return coarsened;
}

Eigen::Vector3f StaticMap::normal_of(const VoxelBlock& block, const Voxel& voxel) const {
  if (has_normal(voxel)) return voxel.normal.normalized();
  return neighbourhood_normal(grid_, block, voxel, viewpoints_.at(voxel.last_frame));
}

template <class Visit>
void StaticMap::for_each_shown(const Visit& visit) const {
  const std::size_t needed = std::min(static_cast<std::size_t>(config_.min_observations), views());
  for (const VoxelBlock& block : grid_.blocks()) {
    for (const Voxel& voxel : block.voxels) {
      if (is_voxel_shown(voxel.hits, block.views, needed)) visit(block, voxel);
    }
  }
}

MapCloud StaticMap::cloud() const {
  MapCloud cloud;
  for_each_shown([&](const VoxelBlock& block, const Voxel& voxel) {
    cloud.points.push_back(voxel.position);
    cloud.colors.push_back(to_rgb(voxel.color));
    cloud.normals.push_back(normal_of(block, voxel));
    cloud.observations.push_back(voxel.hits);
  });
  return cloud;
}

MapCloud StaticMap::cloud_with_normals() const {
  MapCloud cloud = this->cloud();
  std::vector<SparsePoint> sparse;
  std::size_t index = 0;
  for_each_shown([&](const VoxelBlock&, const Voxel& voxel) {
    if (cloud.normals[index].isZero(0.0F)) {
      sparse.push_back({index, viewpoints_.at(voxel.last_frame)});
    }
    ++index;
  });
  fill_sparse_normals(cloud, sparse);
  return cloud;
}

std::vector<Timestamp> StaticMap::stamps() const {
  tsl::robin_map<std::uint32_t, Timestamp> stamp_of;  // by frame number
  for (const FrameViewpoints::Entry& entry : viewpoints_.entries()) {
    stamp_of.emplace(entry.frame, entry.stamp);
  }
  std::vector<Timestamp> stamps;
  for_each_shown([&](const VoxelBlock&, const Voxel& voxel) {
    stamps.push_back(stamp_of.at(voxel.last_frame));
  });
  return stamps;
}

}  // namespace mms
