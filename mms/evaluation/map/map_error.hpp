#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// Accuracy of a static map by the metrics of the KTH DynamicMap benchmark (Zhang et al., ITSC
/// 2023), in percent. NaN if the ground truth has no points of the kind.
struct MapError {
  double SA = 0.0;  ///< static ground-truth points with a map point within the radius
  double DA = 0.0;  ///< dynamic ground-truth points without one, correctly removed
  double AA = 0.0;  ///< sqrt(SA * DA)
  double HA = 0.0;  ///< harmonic mean of SA and DA
  std::size_t static_points = 0;
  std::size_t dynamic_points = 0;    ///< dynamic points used for DA
  std::size_t ambiguous_points = 0;  ///< dynamic points excluded, see evaluate_map
};

/// All points in one world frame [m]; ignores points that are NaN or beyond 1000 km. A dynamic
/// ground-truth point with a static one within `radius` (a shoe on the floor) is ambiguous, because
/// a map point there is correct; such points are excluded from DA and counted. Linear time for maps
/// of bounded density.
/// @throws DataError if the ground truth has no valid points or radius is outside 0.001..100 m
MapError evaluate_map(const std::vector<Eigen::Vector3f>& truth_static,
                      const std::vector<Eigen::Vector3f>& truth_dynamic,
                      const std::vector<Eigen::Vector3f>& map, double radius = 0.05);

/// The same with one cloud of ground truth in its own frame.
/// @param labels  of its points: 0 static
MapError evaluate_labeled_map(const std::vector<Eigen::Vector3f>& truth,
                              const std::vector<std::int32_t>& labels,
                              const Eigen::Isometry3f& T_map_truth,
                              const std::vector<Eigen::Vector3f>& map);

/// JSON keys: sa_pct, da_pct, aa_pct, ha_pct.
std::vector<MetricValue> metric_values(const MapError& error);

}  // namespace mms
