#pragma once

#include <cstddef>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// Drift of a static sensor, as in the paper's table of localization drift: distance of every pose
/// from the first one, which counts with distance 0.
struct Drift {
  std::size_t poses = 0;
  double atde_m = 0.0;  ///< mean
  double mtde_m = 0.0;  ///< maximum
};

/// Needs neither ground truth nor alignment. Ignores poses with NaN or infinite numbers.
/// @throws DataError if no pose is left
Drift evaluate_drift(const Trajectory& estimate);

/// JSON keys: poses, atde_m, mtde_m.
std::vector<MetricValue> metric_values(const Drift& drift);

}  // namespace mms
