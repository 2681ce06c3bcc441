#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/evaluation/trajectory/stamp_matching.hpp"

namespace mms {

/// Unit of the distance between the two poses of a relative pose error.
enum class DeltaUnit {
  kSeconds,  ///< fixed delta of the TUM tool: a pair starts at every matched pose
  kMeters,   ///< path length of the estimate: consecutive pairs without overlap, as in evo
  kFrames,   ///< matched poses: consecutive pairs without overlap, as in evo
};

struct RelativeDelta {
  double value = 1.0;  ///< > 0, in `unit`
  DeltaUnit unit = DeltaUnit::kSeconds;
};

/// Relative pose error (RPE): the error of the motion over a fixed delta, independent of alignment.
/// NaN if the trajectory is shorter than the delta.
struct RelativeError {
  std::size_t pairs = 0;
  double trans_rmse_m = 0.0;
  double rot_rmse_deg = 0.0;
  /// Whether turning the axes of the estimated sensor would remove most of a large error: then the
  /// poses are of another sensor than the reference's, and the error has no meaning. Needs ten
  /// pairs.
  bool axes_differ = false;
};

/// Error (Q_i^-1 Q_j)^-1 (P_i^-1 P_j) of the motion between two matches, of the estimate P against
/// the reference Q (Sturm et al., IROS 2012, eq. 1).
Eigen::Isometry3d relative_pose_error(const Trajectory& reference, const Trajectory& estimate,
                                      const PoseMatch& from, const PoseMatch& to);

/// For pairs (i, j) of matched poses `delta` apart, the root mean square of `relative_pose_error`.
/// In seconds, j is the matched pose nearest to stamp_i + delta; no pair starts if none is within a
/// tenth of delta.
/// @param matches  in order of time
/// @throws DataError if delta is outside 1e-9..1e9, in frames 1..1e9 or not whole
RelativeError relative_error(const Trajectory& reference, const Trajectory& estimate,
                             const std::vector<PoseMatch>& matches, const RelativeDelta& delta);

}  // namespace mms
