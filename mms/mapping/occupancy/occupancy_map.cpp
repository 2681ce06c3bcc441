#include "mms/mapping/occupancy/occupancy_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "mms/geometry/voxels/voxel_ray.hpp"

namespace mms {
namespace {

/// [-]: voxels from the world's origin to the sensor. Source: keys are integers of 32 bits; 2^28
/// leaves rays of 2^28 voxels more.
constexpr double kMaxSensorVoxels = 1 << 28;

/// [-]: rays a voxel has along a side at the largest depth. Source: two, so that none is missed.
constexpr double kRaysPerVoxel = 2.0;

/// [px]: largest step between rays. Source: a tenth of the width of 640 px.
constexpr int kMaxStep = 64;

/// [-]: standard deviations of depth by which rays end before their points. Source: contain 95 % of
/// normal noise.
constexpr float kClearanceSigmas = 2.0F;

/// [-]: consecutive voxels freed by other rays of the scan at which a ray ends. Source: with one or
/// two, voxels beside crossing rays are left out.
constexpr int kMaxRepeated = 4;

/// [-]: share of the memory budget used before voxels are coarsened. Source: the coarser copy is
/// built beside the finer map and has about an eighth of its memory.
constexpr double kMaxMemoryShare = 0.85;

LogOdds log_odds_of(double probability) {
  return static_cast<LogOdds>(
      std::lround(kLogOddsScale * std::log(probability / (1.0 - probability))));
}

/// Adds `step` to the log odds of the voxels whose bits are set in the `word`-th 64 of a block.
void add(std::uint64_t bits, std::size_t word, int step, LogOdds least, LogOdds most,
         OccupancyBlock& block) {
  for (; bits != 0; bits &= bits - 1) {
    LogOdds& value = block.log_odds[64 * word + static_cast<std::size_t>(std::countr_zero(bits))];
    const int before = value == kUnobserved ? 0 : value;
    value = static_cast<LogOdds>(std::clamp<int>(before + step, least, most));
  }
}

}  // namespace

OccupancyMap::OccupancyMap(const OccupancyConfig& config, const SurfaceConfig& surface)
    : config_(config), surface_(surface), blocks_(config.voxel_size) {}

void OccupancyMap::integrate(const LabeledCloud& cloud,
                             const Transform<World, Sensor>& T_world_sensor) {
  if (!config_.enabled || !T_world_sensor.is_finite()) return;
  if (T_world_sensor.translation().cwiseAbs().maxCoeff() > kMaxSensorVoxels * voxel_size()) return;
  const Eigen::Isometry3f T = T_world_sensor.isometry().cast<float>();
  KeyframeMarks marks(blocks_, ++keyframes_, marks_);
  if (cloud.organised()) {
    const int step = step_of(cloud);
    mark_hits(cloud, T, step, marks);
    mark_rays(cloud, T, step, marks);
  } else {
    mark_scan(cloud, T, marks);
  }
  apply();
  keep_to_budget();
}

/// Step between the rows and columns that are used: `kRaysPerVoxel` at the largest depth.
int OccupancyMap::step_of(const LabeledCloud& cloud) const {
  const double pixels = cloud.camera.fx * voxel_size() / surface_.max_depth;
  return std::clamp(static_cast<int>(std::min(pixels / kRaysPerVoxel, 1.0 * kMaxStep)), 1,
                    kMaxStep);
}

void OccupancyMap::mark_hits(const LabeledCloud& cloud, const Eigen::Isometry3f& T_world_sensor,
                             int step, KeyframeMarks& marks) const {
  const auto inverse_size = static_cast<float>(1.0 / voxel_size());
  const auto farthest = static_cast<float>(config_.max_range);
  for (const SurfacePoint& surface : surface_points(cloud, surface_, step)) {
    const float range = surface.point.norm();
    if (!(range > 0.0F && range <= farthest)) continue;
    const VoxelKey key = voxel_key(T_world_sensor * surface.point, inverse_size);
    marks.of(key).hit.test_and_set(BlockCells::cell_of(key));
  }
}

/// The point, or the last one within range on the ray to it.
Eigen::Vector3f OccupancyMap::reach(const Eigen::Vector3f& point) const {
  const float share = std::min(1.0F, static_cast<float>(config_.max_range) / point.norm());
  return std::min(share, static_cast<float>(surface_.max_depth) / point.z()) * point;
}

void OccupancyMap::mark_rays(const LabeledCloud& cloud, const Eigen::Isometry3f& T_world_sensor,
                             int step, KeyframeMarks& marks) const {
  const auto inverse_size = static_cast<float>(1.0 / voxel_size());
  for (int y = 0; y < cloud.height; y += step) {
    for (int x = 0; x < cloud.width; x += step) {
      const std::size_t i = cloud.index(x, y);
      const Eigen::Vector3f& point = cloud.points[i];
      if (cloud.labels[i] == PointLabel::kInvalid || !std::isfinite(point.norm())) continue;
      if (!(point.z() > 0.0F)) continue;
      const Eigen::Vector3f target = reach(point);
      const VoxelKey end = voxel_key(T_world_sensor * target, inverse_size);
      BlockMarks& there = marks.of(end);
      if (cloud.labels[i] == PointLabel::kStatic) there.keep.test_and_set(BlockCells::cell_of(end));
      if (there.end.test_and_set(BlockCells::cell_of(end))) continue;
      mark_depth_ray(target, T_world_sensor, marks);
    }
  }
}

void OccupancyMap::mark_depth_ray(const Eigen::Vector3f& target,
                                  const Eigen::Isometry3f& T_world_sensor,
                                  KeyframeMarks& marks) const {
  const auto inverse_size = static_cast<float>(1.0 / voxel_size());
  const float clearance = static_cast<float>(0.5 * voxel_size()) +
                          kClearanceSigmas * surface_.noise.depth.sigma(target.z());
  const float share = 1.0F - clearance / target.norm();
  if (!(share > 0.0F)) return;
  const Eigen::Vector3f last = T_world_sensor * Eigen::Vector3f(share * target);
  for_each_voxel(inverse_size * T_world_sensor.translation(), inverse_size * last,
                 [&](const VoxelKey& key) {
                   marks.of(key).free.test_and_set(BlockCells::cell_of(key));
                   return true;
                 });
}

void OccupancyMap::mark_scan(const LabeledCloud& cloud, const Eigen::Isometry3f& T_world_sensor,
                             KeyframeMarks& marks) const {
  const auto inverse_size = static_cast<float>(1.0 / voxel_size());
  const auto farthest = static_cast<float>(config_.max_range);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const float range = cloud.points[i].norm();
    if (cloud.labels[i] == PointLabel::kInvalid || !(range > 0.0F && std::isfinite(range)))
      continue;
    const Eigen::Vector3f target = std::min(1.0F, farthest / range) * cloud.points[i];
    const VoxelKey end = voxel_key(T_world_sensor * target, inverse_size);
    const std::uint16_t cell = BlockCells::cell_of(end);
    BlockMarks& there = marks.of(end);
    if (cloud.labels[i] == PointLabel::kStatic) {
      there.keep.test_and_set(cell);
      const bool is_mapped = range <= farthest && range <= static_cast<float>(surface_.max_range);
      if (is_mapped) there.hit.test_and_set(cell);
    }
    if (!there.end.test_and_set(cell)) mark_scan_ray(target, T_world_sensor, marks);
  }
}

void OccupancyMap::mark_scan_ray(const Eigen::Vector3f& target,
                                 const Eigen::Isometry3f& T_world_sensor,
                                 KeyframeMarks& marks) const {
  const auto inverse_size = static_cast<float>(1.0 / voxel_size());
  const float share = 1.0F - static_cast<float>(0.5 * voxel_size()) / target.norm();
  if (!(share > 0.0F)) return;
  const Eigen::Vector3f last = T_world_sensor * Eigen::Vector3f(share * target);
  int repeated = 0;
  for_each_voxel(inverse_size * last, inverse_size * T_world_sensor.translation(),
                 [&](const VoxelKey& key) {
                   const bool is_known = marks.of(key).free.test_and_set(BlockCells::cell_of(key));
                   repeated = is_known ? repeated + 1 : 0;
                   return repeated < kMaxRepeated;
                 });
}

void OccupancyMap::apply() {
  const int hit = log_odds_of(config_.hit);
  const int miss = log_odds_of(config_.miss);
  const LogOdds least = log_odds_of(config_.min_probability);
  const LogOdds most = log_odds_of(config_.max_probability);
  for (const BlockMarks& marks : marks_) {
    for (std::size_t i = 0; i < CellBits::kWords; ++i) {
      add(marks.hit.word(i), i, hit, least, most, *marks.block);
      add(marks.free.word(i) & ~marks.hit.word(i) & ~marks.keep.word(i), i, miss, least, most,
          *marks.block);
    }
  }
}

void OccupancyMap::keep_to_budget() {
  const double limit = kMaxMemoryShare * config_.memory * 1e6;
  while (static_cast<double>(blocks_.memory_bytes()) > limit && blocks_.all().size() > 1) {
    blocks_ = blocks_.coarsened();
    marks_.clear();
  }
}

Occupancy OccupancyMap::at(const Eigen::Vector3d& point) const {
  return at(voxel_key(point.cast<float>(), static_cast<float>(1.0 / voxel_size())));
}

}  // namespace mms
