#include "mms/localization/features/scan_features.hpp"

#include <tsl/robin_set.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "mms/geometry/parallel.hpp"
#include "mms/geometry/voxels/point_map.hpp"
#include "mms/localization/features/local_surface.hpp"

namespace mms {
namespace {

/// [voxels]: grid of the points that neighborhoods are taken from.
/// Source: a plane then has some 20 of them within kNeighborRadius, three times kMinNeighbors.
constexpr double kNeighborGrid = 0.5;

/// [voxels]: radius of the neighborhood of eq. (2) and of the plane fit.
/// Source: initial choice, 2.5 cells of kNeighborGrid.
constexpr float kNeighborRadius = 1.25F;

/// [-]: bound on the points in one cell of the search for neighbors.
/// Source: kNeighborRadius spans up to four cells of kNeighborGrid along each axis: none is lost.
constexpr int kMaxPointsPerCell = 64;

/// [-]: points of the smallest neighborhood. Source: twice the three that determine a plane.
constexpr std::size_t kMinNeighbors = 6;

/// [-]: direction sectors around each of two axes. Source: initial choice, 10 degrees each.
constexpr int kSectors = 36;

/// [-]: edges taken from a direction sector. Source: initial choice, not tuned since.
constexpr std::size_t kEdgesPerSector = 8;

/// [-]: largest thickness of a plane over its width (standard deviations).
/// Source: 2.5 sigma of a LiDAR's 2 cm over the 0.25 m of a disc of 0.5 m radius, which is
/// kNeighborRadius at 10 m.
constexpr float kMaxFlatness = 0.2F;

/// [-]: smallest width of a plane (standard deviation) over the neighborhood's radius.
/// Source: half of a disc's 0.5; a single ring of a scan has only its noise, 0.04.
constexpr float kMinWidth = 0.25F;

/// [-]: smallest cosine between a plane's normal and the ray. Source: the floor 85 m from a sensor
/// at 1.7 m height; a scan's own geometry makes floors grazing, so only degenerate fits are left.
constexpr float kMinIncidence = 0.02F;

/// [-]: points of one parallel task. Source: tens of microseconds, long against the task's start.
constexpr std::size_t kChunk = 256;

using Indices = std::vector<std::size_t>;

Indices static_points(const LabeledCloud& cloud) {
  Indices indices;
  indices.reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] == PointLabel::kStatic) indices.push_back(i);
  }
  return indices;
}

std::vector<Eigen::Vector3f> points_of(const LabeledCloud& cloud, const Indices& indices) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(indices.size());
  for (const std::size_t i : indices) points.push_back(cloud.points[i]);
  return points;
}

/// The first point of each voxel: a mean would lie beside thin structures.
Indices thinned(const LabeledCloud& cloud, const Indices& indices, double voxel) {
  const auto inverse_size = static_cast<float>(1.0 / voxel);
  tsl::robin_set<VoxelKey, VoxelKeyHash> taken;
  Indices kept;
  for (const std::size_t i : indices) {
    if (taken.insert(voxel_key(cloud.points[i], inverse_size)).second) kept.push_back(i);
  }
  return kept;
}

/// Times of the points of a scan, relative to the center between the first and the last.
class PointTimes {
 public:
  explicit PointTimes(const std::vector<float>& time_offset) : time_offset_(time_offset) {
    if (time_offset.empty()) return;
    const auto [first, last] = std::minmax_element(time_offset.begin(), time_offset.end());
    center_ = 0.5F * (*first + *last);
  }

  /// From the center [s].
  float of(std::size_t i) const { return time_offset_.empty() ? 0.0F : time_offset_[i] - center_; }

  /// Of the center, from the scan's stamp.
  Duration center() const {
    return Timestamp::from_seconds(static_cast<double>(center_)) - Timestamp();
  }

 private:
  const std::vector<float>& time_offset_;
  float center_ = 0.0F;
};

struct Analysis {
  float smoothness = 0.0F;  ///< magnitude of eq. (2) over range
  std::optional<PlaneFeature> plane;
};

/// Eq. (2) and the plane through the neighborhood; nothing with too few neighbors.
std::optional<Analysis> analyse(const Eigen::Vector3f& point, const PointMap& map, float radius,
                                const FeatureConfig& config, std::vector<Neighbor>& neighbors) {
  map.within(point, radius, neighbors);
  if (neighbors.size() < kMinNeighbors) return std::nullopt;
  const float range = point.norm();
  float sum = 0.0F;
  PlaneFit fit(point);
  for (const Neighbor& n : neighbors) {
    sum += range - n.point.norm();
    fit.add(n.point);
  }
  Analysis result;
  result.smoothness = std::abs(sum) / static_cast<float>(neighbors.size()) / range;
  const PlaneFit::Plane plane = fit.solve();
  const float incidence = -plane.normal.dot(point) / range;
  const bool flat =
      plane.thickness < kMaxFlatness * plane.width && plane.width > kMinWidth * radius;
  if (flat && incidence > kMinIncidence) {
    result.plane = PlaneFeature{point, plane.normal, static_cast<float>(config.noise.range)};
  }
  return result;
}

/// Index of the direction sector of a point, by azimuth around two axes so that any mounting works.
std::size_t direction_sector(const Eigen::Vector3f& p) {
  const auto sector = [](float a, float b) {
    const float turn = (std::atan2(a, b) / static_cast<float>(M_PI) + 1.0F) * 0.5F;
    return std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1);
  };
  return static_cast<std::size_t>(sector(p.y(), p.x()) * kSectors +
                                  sector(p.z(), p.head<2>().norm()));
}

struct EdgeCandidate {
  std::size_t sector;
  float smoothness;
  std::size_t index;  ///< in the cloud
};

void choose_edges(std::vector<EdgeCandidate>& candidates, const LabeledCloud& cloud,
                  const PointTimes& times, const FeatureConfig& config,
                  std::vector<EdgeFeature>& edges) {
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return std::tie(a.sector, b.smoothness, a.index) < std::tie(b.sector, a.smoothness, b.index);
  });
  std::size_t taken = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i > 0 && candidates[i].sector != candidates[i - 1].sector) taken = 0;
    if (taken++ >= kEdgesPerSector) continue;
    const std::size_t index = candidates[i].index;
    edges.push_back({cloud.points[index], static_cast<float>(config.noise.range), times.of(index),
                     static_cast<int>(index)});
  }
}

double voxel_of(const LabeledCloud& cloud, const Indices& indices) {
  std::vector<float> ranges;
  ranges.reserve(indices.size());
  for (const std::size_t i : indices) ranges.push_back(cloud.points[i].norm());
  return automatic_voxel_size(median_range(std::move(ranges)));
}

}  // namespace

void extract_scan_features(const LabeledCloud& cloud, const FeatureConfig& config,
                           FeatureCloud& features) {
  const PointTimes times(cloud.time_offset);
  features.points_offset = times.center();
  const Indices all = static_points(cloud);
  const double voxel = config.scan_voxel > 0.0 ? config.scan_voxel : voxel_of(cloud, all);
  const Indices dense = thinned(cloud, all, kNeighborGrid * voxel);
  const Indices chosen = thinned(cloud, dense, voxel);
  const std::vector<Eigen::Vector3f> points = points_of(cloud, chosen);
  const float radius = kNeighborRadius * static_cast<float>(voxel);
  PointMap map(radius, {.max_points_per_voxel = kMaxPointsPerCell});
  map.insert(points_of(cloud, dense));

  std::vector<std::optional<Analysis>> analyses(points.size());
  parallel_chunks(points.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> neighbors;
    for (std::size_t i = begin; i < end; ++i) {
      analyses[i] = analyse(points[i], map, radius, config, neighbors);
    }
  });

  std::vector<EdgeCandidate> candidates;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!analyses[i]) continue;
    if (analyses[i]->plane) {
      features.planes.push_back(*analyses[i]->plane);
      features.planes.back().time_offset = times.of(chosen[i]);
      features.planes.back().index = static_cast<int>(chosen[i]);
    } else if (analyses[i]->smoothness > static_cast<float>(config.edge_smoothness)) {
      candidates.push_back({direction_sector(points[i]), analyses[i]->smoothness, chosen[i]});
    }
  }
  choose_edges(candidates, cloud, times, config, features.edges);
}

}  // namespace mms
