#pragma once

#include <cstddef>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/evaluation/trajectory/stamp_matching.hpp"

namespace mms {

/// How far apart the two poses of a relative pose error are.
enum class DeltaUnit {
  kSeconds,  ///< as the TUM tool's fixed delta: a pair starts at every matched pose
  kMeters,   ///< of path the estimate travelled: consecutive pairs that do not overlap, as in evo
  kFrames,   ///< matched poses: consecutive pairs that do not overlap, as in evo
};

struct RelativeDelta {
  double value = 1.0;  ///< > 0, in `unit`
  DeltaUnit unit = DeltaUnit::kSeconds;
};

/// Relative pose error (RPE): the error of the motion over a fixed delta, which no alignment
/// changes. NaN where the trajectory is shorter than the delta.
struct RelativeError {
  std::size_t pairs = 0;
  double trans_rmse_m = 0.0;
  double rot_rmse_deg = 0.0;
};

/// Of the pairs (i, j) of matched poses `delta` apart, the error (Q_i^-1 Q_j)^-1 (P_i^-1 P_j) with
/// the reference Q and the estimate P (Sturm et al., IROS 2012, eq. 1). In seconds, j is the
/// matched pose nearest to stamp_i + delta; where a gap leaves none within a tenth of delta, no
/// pair starts.
/// @param matches  in the order of time
/// @throws DataError when delta is not in 1e-9..1e9, in frames 1..1e9
RelativeError relative_error(const Trajectory& reference, const Trajectory& estimate,
                             const std::vector<PoseMatch>& matches, const RelativeDelta& delta);

}  // namespace mms
