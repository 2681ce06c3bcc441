#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// Cleanness of a static map by the measures of the KTH DynamicMap benchmark (Zhang et al., ITSC
/// 2023), in percent. NaN where the truth has no points of the kind.
struct MapError {
  double SA = 0.0;  ///< static points of the truth that have a map point within the radius
  double DA = 0.0;  ///< dynamic points of the truth that have none: removed as they should be
  double AA = 0.0;  ///< sqrt(SA * DA)
  double HA = 0.0;  ///< harmonic mean of SA and DA
  std::size_t static_points = 0;
  std::size_t dynamic_points = 0;    ///< those DA is taken over
  std::size_t ambiguous_points = 0;  ///< dynamic points left out, see evaluate_map
};

/// All points in one world frame [m]; points that are NaN or beyond 1000 km are ignored. A dynamic
/// point of the truth with a static one within `radius` (a shoe on the floor) is ambiguous: the map
/// is right to have a point there. Such points are left out of DA and counted. Time linear in the
/// points for maps of bounded density.
/// @throws DataError when the truth has no usable points or radius is not in 0.001..100 m
MapError evaluate_map(const std::vector<Eigen::Vector3f>& truth_static,
                      const std::vector<Eigen::Vector3f>& truth_dynamic,
                      const std::vector<Eigen::Vector3f>& map, double radius = 0.05);

/// The contract's keys: SA, DA, AA, HA.
std::vector<MetricValue> metric_values(const MapError& error);

}  // namespace mms
