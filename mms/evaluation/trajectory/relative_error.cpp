#include "mms/evaluation/trajectory/relative_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/evaluation/scores/metric_value.hpp"
#include "mms/evaluation/scores/statistics.hpp"
#include "mms/evaluation/trajectory/alignment.hpp"
#include "mms/geometry/se3.hpp"

namespace mms {
namespace {

/// Tolerance of the time difference of a pair, as a share of delta.
constexpr double kTimeTolerance = 0.1;

/// Indices of the first and second match of each pair.
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

Pairs pairs_by_time(const std::vector<Timestamp>& stamps, double seconds) {
  const auto delta = std::chrono::round<Duration>(std::chrono::duration<double>(seconds));
  const auto tolerance = std::chrono::round<Duration>(kTimeTolerance * delta);
  Pairs pairs;
  for (std::size_t i = 0; i + 1 < stamps.size() && stamps[i] + delta <= stamps.back(); ++i) {
    const Timestamp target = stamps[i] + delta;
    const auto from = stamps.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    auto j = std::lower_bound(from, stamps.end(), target);
    if (j != from && target - *(j - 1) < *j - target) --j;
    if (std::chrono::abs(*j - target) > tolerance) continue;
    pairs.emplace_back(i, static_cast<std::size_t>(j - stamps.begin()));
  }
  return pairs;
}

Pairs consecutive(const std::vector<std::size_t>& places) {
  Pairs pairs;
  for (std::size_t i = 1; i < places.size(); ++i) pairs.emplace_back(places[i - 1], places[i]);
  return pairs;
}

/// As in evo: a pair ends, and the next begins, where the path since the last end reaches delta.
Pairs pairs_by_path(const std::vector<Eigen::Vector3d>& positions, double delta) {
  std::vector<std::size_t> places;
  double path = 0.0;
  for (std::size_t i = 1; i < positions.size(); ++i) {
    path += (positions[i] - positions[i - 1]).norm();
    if (path < delta) continue;
    places.push_back(i);
    path = 0.0;
  }
  return consecutive(places);
}

Pairs pairs_by_frames(std::size_t count, std::size_t step) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < count; i += step) places.push_back(i);
  return consecutive(places);
}

Pairs choose_pairs(const Trajectory& estimate, const std::vector<PoseMatch>& matches,
                   const RelativeDelta& delta) {
  if (delta.unit == DeltaUnit::kFrames) {
    return pairs_by_frames(matches.size(), static_cast<std::size_t>(delta.value));
  }
  std::vector<Timestamp> stamps;
  std::vector<Eigen::Vector3d> positions;
  for (const PoseMatch& match : matches) {
    const StampedPose& pose = estimate[match.estimate];
    stamps.push_back(pose.stamp);
    positions.push_back(pose.T_world_sensor.translation());
  }
  return delta.unit == DeltaUnit::kSeconds ? pairs_by_time(stamps, delta.value)
                                           : pairs_by_path(positions, delta.value);
}

/// Allowed deltas: from a nanosecond, or a frame, to numbers that all types used here represent.
void check(const RelativeDelta& delta) {
  constexpr double kMax = 1e9;
  const double min = delta.unit == DeltaUnit::kFrames ? 1.0 : 1e-9;
  if (delta.unit == DeltaUnit::kFrames && delta.value != std::floor(delta.value)) {
    throw DataError("relative pose error",
                    "delta " + to_fixed(delta.value, 9) + " frames is not a whole number");
  }
  if (delta.value >= min && delta.value <= kMax) return;
  throw DataError("relative pose error",
                  "delta " + to_fixed(delta.value, 9) +
                      (delta.unit == DeltaUnit::kFrames ? " frames is outside 1..1e9"
                                                        : " is outside 1e-9..1e9 s or m"));
}

Eigen::Isometry3d motion(const Trajectory& trajectory, std::size_t from, std::size_t to) {
  return (trajectory[from].T_world_sensor.inverse() * trajectory[to].T_world_sensor).isometry();
}

/// Motions of the pairs, each in the axes of its sensor [m].
struct Motions {
  std::vector<Eigen::Vector3d> reference;
  std::vector<Eigen::Vector3d> estimate;
};

void add_both(std::vector<Eigen::Vector3d>& vectors, const Eigen::Vector3d& vector) {
  vectors.push_back(vector);
  vectors.emplace_back(-vector);
}

bool axes_differ(const Motions& motions) {
  constexpr std::size_t kMinPairs = 10;
  constexpr double kLarge = 0.2;  // share of the motion: that of axes 12 degrees apart
  constexpr double kLeft = 0.3;   // share of the error
  if (motions.reference.size() < kMinPairs) return false;
  // With each motion and its opposite the centers are zero, and only the rotation is fitted.
  Motions both;
  for (const Eigen::Vector3d& move : motions.reference) add_both(both.reference, move);
  for (const Eigen::Vector3d& move : motions.estimate) add_both(both.estimate, move);
  const Eigen::Matrix3d turn = align_points(both.estimate, both.reference).linear();
  double length2 = 0.0;
  double error2 = 0.0;
  double left2 = 0.0;
  for (std::size_t i = 0; i < motions.reference.size(); ++i) {
    length2 += motions.reference[i].squaredNorm();
    error2 += (motions.reference[i] - motions.estimate[i]).squaredNorm();
    left2 += (motions.reference[i] - turn * motions.estimate[i]).squaredNorm();
  }
  return error2 > kLarge * kLarge * length2 && left2 < kLeft * kLeft * error2;
}

}  // namespace

Eigen::Isometry3d relative_pose_error(const Trajectory& reference, const Trajectory& estimate,
                                      const PoseMatch& from, const PoseMatch& to) {
  const Eigen::Isometry3d truth = motion(reference, from.reference, to.reference);
  return truth.inverse() * motion(estimate, from.estimate, to.estimate);
}

RelativeError relative_error(const Trajectory& reference, const Trajectory& estimate,
                             const std::vector<PoseMatch>& matches, const RelativeDelta& delta) {
  check(delta);
  std::vector<double> distances;
  std::vector<double> angles;
  Motions motions;
  for (const auto& [i, j] : choose_pairs(estimate, matches, delta)) {
    const Eigen::Isometry3d error =
        relative_pose_error(reference, estimate, matches[i], matches[j]);
    distances.push_back(error.translation().norm());
    angles.push_back(se3::angle(error) * 180.0 / std::numbers::pi);
    motions.reference.emplace_back(
        motion(reference, matches[i].reference, matches[j].reference).translation());
    motions.estimate.emplace_back(
        motion(estimate, matches[i].estimate, matches[j].estimate).translation());
  }
  return {distances.size(), root_mean_square(distances), root_mean_square(angles),
          axes_differ(motions)};
}

}  // namespace mms
