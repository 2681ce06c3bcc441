#include "mms/localization/features/scan_features.hpp"

#include <tsl/robin_set.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "mms/geometry/parallel.hpp"
#include "mms/geometry/principal_axes.hpp"
#include "mms/geometry/voxels/voxel_hash_map.hpp"

namespace mms {
namespace {

/// [voxels]: side of the cells that features and neighborhoods are taken from. Source: initial
/// choice; 3 cells are 0.75 m at a median range of 5 m, where rings of 16 are 0.17 m apart.
constexpr double kCell = 1.25;

/// [-]: in cells, grid of the points that neighborhoods are made of, so that rings and near
/// surfaces do not outweigh the rest. Source: a plane then has some 30 of them in a neighborhood.
constexpr double kNeighborGrid = 0.5;

/// [-]: in cells, half the side of the cube of eq. (2) and of the plane fit. Source: a cell and the
/// 26 around it.
constexpr double kNeighborRadius = 1.5;

/// [-]: points of the smallest neighborhood. Source: twice the three that determine a plane.
constexpr double kMinNeighbors = 6.0;

/// [-]: direction sectors around each of two axes. Source: initial choice, 10 degrees each.
constexpr int kSectors = 36;

/// [-]: edges taken from a direction sector. Source: initial choice, not tuned since.
constexpr std::size_t kEdgesPerSector = 8;

/// [-]: largest thickness of a plane over its width (standard deviations).
/// Source: 2.5 sigma of a LiDAR's 2 cm over the 0.25 m of a disc of 0.5 m radius, which is
/// kNeighborRadius at 8 m.
constexpr double kMaxFlatness = 0.2;

/// [-]: smallest width of a plane (standard deviation) over the neighborhood's radius.
/// Source: half of a disc's 0.5; a single ring of a scan has only its noise, 0.04.
constexpr double kMinWidth = 0.25;

/// [-]: largest thickness of a plane (standard deviation), by the noise of range.
/// Source: 95 % of the normal distribution; thicker ones are steps and creases.
constexpr double kMaxThickness = 2.0;

/// [-]: largest distance of a feature from the plane of its neighborhood, by the noise of range.
/// Source: three-sigma rule.
constexpr double kMaxDistance = 3.0;

/// [-]: noise of a plane fitted to a neighborhood over that of one point. Source: 1 / sqrt(n) of
/// kMinNeighbors points is 0.41, and more to the side of their mean.
constexpr double kPlaneSigma = 0.5;

/// [-]: smallest cosine between a plane's normal and the ray. Source: the floor 85 m from a sensor
/// at 1.7 m height; a scan's own geometry makes floors grazing, so only degenerate fits are left.
constexpr double kMinIncidence = 0.02;

/// [-]: points of one parallel task. Source: tens of microseconds, long against the task's start.
constexpr std::size_t kChunk = 256;

/// Times of the points of a scan, relative to the center between the first and the last.
class PointTimes {
 public:
  explicit PointTimes(const std::vector<float>& time_offset) : time_offset_(time_offset) {
    if (time_offset.empty()) return;
    const auto [first, last] = std::minmax_element(time_offset.begin(), time_offset.end());
    center_ = 0.5F * (*first + *last);
    half_duration_ = center_ - *first;
  }

  /// From the center [s].
  float of(std::size_t i) const { return time_offset_.empty() ? 0.0F : time_offset_[i] - center_; }

  /// Of the center, from the scan's stamp.
  Duration center() const { return duration_of(center_); }

  /// From the first point to the center.
  Duration half_duration() const { return duration_of(half_duration_); }

 private:
  static Duration duration_of(float seconds) {
    return Timestamp::from_seconds(static_cast<double>(seconds)) - Timestamp();
  }

  const std::vector<float>& time_offset_;
  float center_ = 0.0F;         // [s]
  float half_duration_ = 0.0F;  // [s]
};

/// Sums over points, in double precision, in which the coordinates of a scan leave enough digits.
struct Moments {
  double count = 0.0;
  double range = 0.0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3f& p) {
    const Eigen::Vector3d q = p.cast<double>();
    count += 1.0;
    range += q.norm();
    point += q;
    square += q * q.transpose();
  }
  void add(const Moments& other) {
    count += other.count;
    range += other.range;
    point += other.point;
    square += other.square;
  }
};

/// The static points of a scan by cell, and by cells of twice the side. Every point is looked up
/// once; only the first of each cell of `kNeighborGrid` adds to the moments.
class ScanCells {
 public:
  ScanCells(const LabeledCloud& cloud, double side)
      : side_(side), fine_(side, kUnbounded), coarse_(2.0 * side, kUnbounded) {
    const auto inverse_grid = static_cast<float>(1.0 / (kNeighborGrid * side));
    tsl::robin_set<VoxelKey, VoxelKeyHash> taken(cloud.points.size() / 4);
    std::optional<VoxelKey> last;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      if (cloud.labels[i] != PointLabel::kStatic) continue;
      const VoxelKey key = voxel_key(cloud.points[i], inverse_grid);
      if (key == last) continue;  // neighbors in a ring
      last = key;
      if (!taken.insert(key).second) continue;
      Cell& cell = fine_.touch({key.x >> 1, key.y >> 1, key.z >> 1});
      if (cell.moments.count == 0.0) cell.first = i;
      cell.moments.add(cloud.points[i]);
    }
    for (const auto& [key, tick, cell] : fine_.entries()) {
      coarse_.touch({key.x >> 1, key.y >> 1, key.z >> 1}).add(cell.moments);
    }
  }

  std::size_t size() const { return fine_.size(); }

  /// Index of a cell's first point: a mean would lie beside thin structures.
  std::size_t first(std::size_t cell) const { return fine_.entries()[cell].cell.first; }

  struct Neighborhood {
    Moments moments;
    double radius = 0.0;  ///< half the side of its cube [m]
  };

  /// Of a cell and the 26 around it.
  Neighborhood around(std::size_t cell) const {
    Neighborhood result{{}, kNeighborRadius * side_};
    for_each_around(fine_, fine_.entries()[cell].key,
                    [&](const Cell& near) { result.moments.add(near.moments); });
    return result;
  }

  /// Of the cell of twice the side and the 26 around it.
  Neighborhood wide_around(std::size_t cell) const {
    const VoxelKey& key = fine_.entries()[cell].key;
    Neighborhood result{{}, 2.0 * kNeighborRadius * side_};
    for_each_around(coarse_, {key.x >> 1, key.y >> 1, key.z >> 1},
                    [&](const Moments& near) { result.moments.add(near); });
    return result;
  }

 private:
  struct Cell {
    std::size_t first = 0;
    Moments moments;
  };

  template <class Map, class Visit>
  static void for_each_around(const Map& map, const VoxelKey& key, const Visit& visit) {
    map.for_each_in({key.x - 1, key.y - 1, key.z - 1}, {key.x + 1, key.y + 1, key.z + 1}, visit);
  }

  static constexpr std::size_t kUnbounded = std::numeric_limits<std::size_t>::max();

  double side_;
  VoxelHashMap<Cell> fine_;
  VoxelHashMap<Moments> coarse_;
};

/// The point on the plane through a neighborhood; nothing where that is no plane.
std::optional<PlaneFeature> plane_at(const Eigen::Vector3f& point,
                                     const ScanCells::Neighborhood& around, double sigma) {
  const Moments& sums = around.moments;
  if (sums.count < kMinNeighbors) return std::nullopt;
  const Eigen::Vector3d mean = sums.point / sums.count;
  const Eigen::Matrix3d covariance = sums.square / sums.count - mean * mean.transpose();
  const auto axes = principal_axes(covariance, EigenMethod::kClosedForm);
  const double thickness = std::sqrt(std::max(0.0, axes.variances(0)));
  const double width = std::sqrt(std::max(0.0, axes.variances(1)));
  const Eigen::Vector3d to_sensor = -point.cast<double>();
  const Eigen::Vector3d normal = oriented(axes.smallest(), to_sensor);
  const double distance = normal.dot(-to_sensor - mean);
  const bool is_flat = thickness < std::min(kMaxFlatness * width, kMaxThickness * sigma) &&
                       width > kMinWidth * around.radius;
  const bool is_seen = normal.dot(to_sensor) > kMinIncidence * to_sensor.norm();
  if (!is_flat || !is_seen || std::abs(distance) > kMaxDistance * sigma) return std::nullopt;
  return PlaneFeature{point - (distance * normal).cast<float>(), normal.cast<float>(),
                      static_cast<float>(kPlaneSigma * sigma)};
}

struct Analysis {
  float smoothness = 0.0F;  ///< magnitude of eq. (2) over range; 0 with too few neighbors
  std::optional<PlaneFeature> plane;
};

/// Where the neighborhood is no plane, because it has a single ring of a sparse scan, the plane is
/// that of twice its size.
Analysis analyse(const Eigen::Vector3f& point, const ScanCells& cells, std::size_t cell,
                 double sigma) {
  const ScanCells::Neighborhood around = cells.around(cell);
  Analysis result;
  result.plane = plane_at(point, around, sigma);
  if (!result.plane) result.plane = plane_at(point, cells.wide_around(cell), sigma);
  if (around.moments.count >= kMinNeighbors) {
    const auto range = static_cast<double>(point.norm());
    const double mean_range = around.moments.range / around.moments.count;
    result.smoothness = static_cast<float>(std::abs(range - mean_range) / range);
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

double voxel_of(const LabeledCloud& cloud) {
  std::vector<float> ranges;
  ranges.reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] == PointLabel::kStatic) ranges.push_back(cloud.points[i].norm());
  }
  return automatic_voxel_size(median_range(std::move(ranges)));
}

}  // namespace

void extract_scan_features(const LabeledCloud& cloud, const FeatureConfig& config,
                           FeatureCloud& features) {
  const PointTimes times(cloud.time_offset);
  features.points_offset = times.center();
  features.half_duration = times.half_duration();
  const double voxel = config.scan_voxel > 0.0 ? config.scan_voxel : voxel_of(cloud);
  const ScanCells cells(cloud, kCell * voxel);
  std::vector<Analysis> analyses(cells.size());
  parallel_chunks(cells.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      analyses[i] = analyse(cloud.points[cells.first(i)], cells, i, config.noise.range);
    }
  });

  std::vector<EdgeCandidate> candidates;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t first = cells.first(i);
    if (analyses[i].plane) {
      features.planes.push_back(*analyses[i].plane);
      features.planes.back().time_offset = times.of(first);
      features.planes.back().index = static_cast<int>(first);
    } else if (analyses[i].smoothness > static_cast<float>(config.edge_smoothness)) {
      candidates.push_back({direction_sector(cloud.points[first]), analyses[i].smoothness, first});
    }
  }
  choose_edges(candidates, cloud, times, config, features.edges);
}

}  // namespace mms
