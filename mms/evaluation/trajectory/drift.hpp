#pragma once

#include <cstddef>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// Drift of a sensor that stood still, as in the paper's table of localisation drift: translational
/// distance of every pose from the first one, which itself counts with distance 0.
struct Drift {
  std::size_t poses = 0;
  double atde_cm = 0.0;  ///< mean
  double mtde_cm = 0.0;  ///< maximum
};

/// Needs no truth and no alignment. Poses with NaN or infinite numbers do not count.
/// @throws DataError when no pose is left
Drift evaluate_drift(const Trajectory& estimate);

/// The contract's keys: poses, atde_cm, mtde_cm.
std::vector<MetricValue> metric_values(const Drift& drift);

}  // namespace mms
