#pragma once

#include <cstddef>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/evaluation/scores/metric_value.hpp"
#include "mms/evaluation/trajectory/stamp_matching.hpp"

namespace mms {

/// Drift as in the odometry benchmark of KITTI (Geiger et al., CVPR 2012): errors over parts of
/// 100, 200, ... 800 m of the true path, divided by these lengths; means over all parts. NaN if the
/// path is not longer than 100 m.
struct KittiDrift {
  std::size_t parts = 0;          ///< of the path
  double trans_pct = 0.0;         ///< [%]
  double rot_deg_per_100m = 0.0;  ///< [degrees per 100 m]
};

/// As the devkit: a part begins at every tenth matched pose, and ends at the first one beyond its
/// length.
/// @param matches  in order of time
KittiDrift kitti_drift(const Trajectory& reference, const Trajectory& estimate,
                       const std::vector<PoseMatch>& matches);

/// JSON keys: kitti_trans_pct, kitti_rot_deg_per_100m.
std::vector<MetricValue> metric_values(const KittiDrift& drift);

}  // namespace mms
