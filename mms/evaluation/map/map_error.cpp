#include "mms/evaluation/map/map_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mms/core/error.hpp"
#include "mms/geometry/voxels/voxel_hash_map.hpp"

namespace mms {
namespace {

using Points = std::vector<Eigen::Vector3f>;

/// Larger coordinates [m] are invalid and would overflow the voxel grid.
constexpr float kMaxCoordinate = 1e6F;

bool usable(const Eigen::Vector3f& point) {
  return (point.array().abs() <= kMaxCoordinate).all();
}

/// Whether a point of a fixed cloud is within the radius. The voxel size is the radius, so only the
/// 27 voxels around the query are searched.
class ProximityIndex {
 public:
  ProximityIndex(const Points& points, double radius)
      : squared_radius_(static_cast<float>(radius * radius)),
        voxels_(radius, std::numeric_limits<std::size_t>::max()) {
    for (const Eigen::Vector3f& point : points) {
      if (usable(point)) voxels_.touch(voxels_.key(point)).push_back(point);
    }
  }

  bool near(const Eigen::Vector3f& query) const {
    const VoxelKey centre = voxels_.key(query);
    if (near_in(centre, query)) return true;
    for (int x = centre.x - 1; x <= centre.x + 1; ++x) {
      for (int y = centre.y - 1; y <= centre.y + 1; ++y) {
        for (int z = centre.z - 1; z <= centre.z + 1; ++z) {
          if (near_in({x, y, z}, query)) return true;
        }
      }
    }
    return false;
  }

 private:
  bool near_in(const VoxelKey& key, const Eigen::Vector3f& query) const {
    const Points* points = voxels_.find(key);
    return points != nullptr &&
           std::any_of(points->begin(), points->end(), [&](const Eigen::Vector3f& point) {
             return (point - query).squaredNorm() <= squared_radius_;
           });
  }

  float squared_radius_;
  VoxelHashMap<Points> voxels_;
};

double percent(std::size_t part, std::size_t whole) {
  if (whole == 0) return std::numeric_limits<double>::quiet_NaN();
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

void evaluate_static(const Points& truth, const ProximityIndex& map, MapError& error) {
  std::size_t kept = 0;
  for (const Eigen::Vector3f& point : truth) {
    if (!usable(point)) continue;
    ++error.static_points;
    if (map.near(point)) ++kept;
  }
  error.SA = percent(kept, error.static_points);
}

void evaluate_dynamic(const Points& truth, const ProximityIndex& map, const ProximityIndex& fixed,
                      MapError& error) {
  std::size_t removed = 0;
  for (const Eigen::Vector3f& point : truth) {
    if (!usable(point)) continue;
    if (fixed.near(point)) {
      ++error.ambiguous_points;
      continue;
    }
    ++error.dynamic_points;
    if (!map.near(point)) ++removed;
  }
  error.DA = percent(removed, error.dynamic_points);
}

}  // namespace

MapError evaluate_map(const Points& truth_static, const Points& truth_dynamic, const Points& map,
                      double radius) {
  if (!(radius >= 0.001 && radius <= 100.0)) {
    throw DataError("map accuracy", "radius " + to_fixed(radius, 6) + " m is outside 0.001..100");
  }
  MapError error;
  const ProximityIndex map_index(map, radius);
  evaluate_static(truth_static, map_index, error);
  evaluate_dynamic(truth_dynamic, map_index, ProximityIndex(truth_static, radius), error);
  if (error.static_points + error.dynamic_points == 0) {
    throw DataError("map accuracy", "the ground truth has no valid points");
  }
  const double sum = error.SA + error.DA;
  error.AA = std::sqrt(error.SA * error.DA);
  error.HA = sum == 0.0 ? 0.0 : 2.0 * error.SA * error.DA / sum;
  return error;
}

MapError evaluate_labeled_map(const Points& truth, const std::vector<std::int32_t>& labels,
                              const Eigen::Isometry3f& T_map_truth, const Points& map) {
  Points fixed;
  Points dynamic;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    (labels[i] == 0 ? fixed : dynamic).push_back(T_map_truth * truth[i]);
  }
  return evaluate_map(fixed, dynamic, map);
}

std::vector<MetricValue> metric_values(const MapError& error) {
  return {{"sa_pct", "SA (static points kept)", error.SA, "%", 2},
          {"da_pct", "DA (dynamic points removed)", error.DA, "%", 2},
          {"aa_pct", "AA (geometric mean)", error.AA, "%", 2},
          {"ha_pct", "HA (harmonic mean)", error.HA, "%", 2}};
}

}  // namespace mms
