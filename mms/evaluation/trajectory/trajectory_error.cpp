#include "mms/evaluation/trajectory/trajectory_error.hpp"

#include <string>

#include "mms/core/error.hpp"
#include "mms/evaluation/scores/statistics.hpp"
#include "mms/evaluation/trajectory/alignment.hpp"
#include "mms/evaluation/trajectory/stamp_matching.hpp"

namespace mms {
namespace {

constexpr std::size_t kMinMatches = 3;

std::vector<PoseMatch> match(const Trajectory& reference, const Trajectory& estimate,
                             const TrajectoryErrorOptions& options) {
  return options.matching == Matching::kByIndex
             ? match_by_index(reference, estimate)
             : match_by_stamp(reference, estimate, options.max_difference);
}

std::string stamp_range(const Trajectory& trajectory) {
  if (trajectory.empty()) return "none";
  return trajectory.front().stamp.to_string() + ".." + trajectory.back().stamp.to_string();
}

[[noreturn]] void throw_too_few(const Trajectory& reference, const Trajectory& estimate,
                                const TrajectoryErrorOptions& options, std::size_t matched) {
  std::string what = std::to_string(matched) + " of " + std::to_string(estimate.size()) +
                     " estimated poses match one of " + std::to_string(reference.size()) +
                     " reference poses, at least " + std::to_string(kMinMatches) + " are needed";
  if (options.matching == Matching::kByIndex) throw DataError("trajectory", what);
  what += "; matched within " + to_fixed(to_seconds(options.max_difference), 3) + " s, stamps " +
          stamp_range(estimate) + " against " + stamp_range(reference);
  throw DataError("trajectory", what, "are both from the same recording and clock?");
}

/// Distances of matched positions, after alignment if wanted [m].
std::vector<double> absolute_errors(const Trajectory& reference, const Trajectory& estimate,
                                    const std::vector<PoseMatch>& matches, bool align) {
  std::vector<Eigen::Vector3d> source;
  std::vector<Eigen::Vector3d> target;
  for (const PoseMatch& pair : matches) {
    source.push_back(estimate[pair.estimate].T_world_sensor.translation());
    target.push_back(reference[pair.reference].T_world_sensor.translation());
  }
  const Eigen::Isometry3d T_reference_estimate =
      align ? align_points(source, target) : Eigen::Isometry3d::Identity();
  std::vector<double> errors;
  for (std::size_t i = 0; i < source.size(); ++i) {
    errors.push_back((target[i] - T_reference_estimate * source[i]).norm());
  }
  return errors;
}

double path_length(const Trajectory& reference, const std::vector<PoseMatch>& matches) {
  double length = 0.0;
  for (std::size_t i = 1; i < matches.size(); ++i) {
    length += (reference[matches[i].reference].T_world_sensor.translation() -
               reference[matches[i - 1].reference].T_world_sensor.translation())
                  .norm();
  }
  return length;
}

}  // namespace

RelativeDelta rpe_delta(const TrajectoryErrorOptions& options) {
  if (options.rpe_delta) return *options.rpe_delta;
  return options.matching == Matching::kByIndex ? RelativeDelta{10.0, DeltaUnit::kMeters}
                                                : RelativeDelta{1.0, DeltaUnit::kSeconds};
}

TrajectoryError evaluate_trajectory(const Trajectory& reference, const Trajectory& estimate,
                                    const TrajectoryErrorOptions& options) {
  const std::vector<PoseMatch> matches = match(reference, estimate, options);
  if (matches.size() < kMinMatches) throw_too_few(reference, estimate, options, matches.size());
  const std::vector<double> errors = absolute_errors(reference, estimate, matches, options.align);
  return {.matched = matches.size(),
          .poses = estimate.size(),
          .path_m = path_length(reference, matches),
          .ate_rmse_m = root_mean_square(errors),
          .ate_mean_m = mean(errors),
          .ate_median_m = median(errors),
          .ate_max_m = maximum(errors),
          .rpe = relative_error(reference, estimate, matches, rpe_delta(options))};
}

std::vector<MetricValue> metric_values(const TrajectoryError& error) {
  return {{"matched", "matched poses", static_cast<double>(error.matched), "", 0},
          {"poses", "estimated poses", static_cast<double>(error.poses), "", 0},
          {"path_m", "length of the true path", error.path_m, "m", 2},
          {"ate_rmse_m", "ATE rmse", error.ate_rmse_m, "m", 4},
          {"ate_mean_m", "ATE mean", error.ate_mean_m, "m", 4},
          {"ate_median_m", "ATE median", error.ate_median_m, "m", 4},
          {"ate_max_m", "ATE max", error.ate_max_m, "m", 4},
          {"rpe_trans_rmse_m", "drift (RPE translation rmse)", error.rpe.trans_rmse_m, "m", 4},
          {"rpe_rot_rmse_deg", "drift (RPE rotation rmse)", error.rpe.rot_rmse_deg, "deg", 3}};
}

}  // namespace mms
