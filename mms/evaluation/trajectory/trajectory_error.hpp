#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/evaluation/scores/metric_value.hpp"
#include "mms/evaluation/trajectory/relative_error.hpp"

namespace mms {

enum class Matching {
  kByStamp,  ///< nearest stamps (match_by_stamp)
  kByIndex,  ///< frame by frame (match_by_index)
};

struct TrajectoryErrorOptions {
  Matching matching = Matching::kByStamp;
  Duration max_difference{20'000'000};  ///< of matched stamps [ns], inclusive
  bool align = true;  ///< false: both are in one frame, as after localization in a known map
  /// Of the relative pose error; by default 1 s (TUM) by stamp and 10 m of path (KITTI) by index.
  std::optional<RelativeDelta> rpe_delta{};
};

/// The delta used with `options`.
RelativeDelta rpe_delta(const TrajectoryErrorOptions& options);

/// Error of an estimated trajectory against its reference.
struct TrajectoryError {
  std::size_t matched = 0;  ///< matched poses of the estimate
  std::size_t poses = 0;    ///< poses of the estimate
  double path_m = 0.0;      ///< length of the reference through the matched poses [m]
  /// Absolute trajectory error (ATE): distances of matched positions after rigid alignment of the
  /// estimate to the reference, without scale, unless `align` is false [m].
  double ate_rmse_m = 0.0;
  double ate_mean_m = 0.0;
  double ate_median_m = 0.0;
  double ate_max_m = 0.0;
  RelativeError rpe{};
};

/// @throws DataError if fewer than three poses match
TrajectoryError evaluate_trajectory(const Trajectory& reference, const Trajectory& estimate,
                                    const TrajectoryErrorOptions& options = {});

/// JSON keys: matched, poses, path_m, ate_*_m, rpe_trans_rmse_m, rpe_rot_rmse_deg.
std::vector<MetricValue> metric_values(const TrajectoryError& error);

}  // namespace mms
