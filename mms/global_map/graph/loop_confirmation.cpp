#include "mms/global_map/graph/loop_confirmation.hpp"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

namespace mms {
namespace {

/// [-]: inliers of a loop between sessions that nothing relates, as a multiple of those of a loop.
/// Source: initial choice; `kSumFactor` decides.
constexpr double kMinFactor = 1.25;

/// [-]: the same of all such loops that agree, together: two or three keyframes. Source: as
/// `kMinFactor`, of two keyframes.
constexpr int kSumFactor = 4;

/// [-]: keyframes between two loops that confirm each other, at most. Source: one of them
/// may be covered by people.
constexpr std::size_t kConfirmation = 2;

/// [m]: largest distance of the positions that two loops give. Source: 95 % of the errors of loops
/// are below 1 cm; along a corridor they are larger.
constexpr double kMaxDifference = 0.05;

/// [rad]: the same of the angle. Source: 95 % of the errors are below 0.1 degrees.
constexpr double kMaxTurn = std::numbers::pi / 180.0;

}  // namespace

bool LoopConfirmation::is_likely(const LoopGraph& graph, const Loop& loop, int min_inliers) const {
  const std::optional<Matrix6d> covariance = graph.relative_covariance(loop.candidate, loop.query);
  if (!covariance) return loop.inliers >= kMinFactor * min_inliers;
  const Eigen::Isometry3d expected =
      graph.poses()[loop.candidate].inverse() * graph.poses()[loop.query];
  PoseEdge edge{loop.candidate, loop.query, loop.T_candidate_query, {}};
  edge.information = covariance->inverse();
  return squared_deviation(edge, expected) < kMaxSquaredDeviation;
}

std::vector<Loop> LoopConfirmation::confirm(LoopGraph& graph, int min_inliers) {
  std::vector<Loop>& loops = graph.loops();
  Loop& loop = loops.back();
  loop.outcome = LoopOutcome::kUnconfirmed;  // so that it relates no sessions by itself
  const auto pose_by = [&](const Loop& l) -> Eigen::Isometry3d {
    // Pose of the new keyframe in the global frame, by the odometry since the loop.
    return graph.poses()[l.candidate] * l.T_candidate_query * graph.poses()[l.query].inverse() *
           graph.poses()[loop.query];
  };
  const auto agrees = [&](std::size_t i) {
    if (!graph.are_in_one_frame(loops[i].candidate, loop.candidate)) return false;
    const Eigen::Isometry3d difference = pose_by(loops[i]).inverse() * pose_by(loop);
    return difference.translation().norm() < kMaxDifference && se3::angle(difference) < kMaxTurn;
  };
  std::erase_if(pending_, [&](std::size_t i) {
    return loops[i].query + kConfirmation < loop.query ||
           loops[i].outcome == LoopOutcome::kInconsistent;
  });
  std::vector<Loop> accepted;
  std::vector<std::size_t> others;
  std::copy_if(pending_.begin(), pending_.end(), std::back_inserter(others), agrees);
  const bool is_related = graph.relative_covariance(loop.candidate, loop.query).has_value();
  int inliers = loop.inliers;
  for (const std::size_t i : others) inliers += loops[i].inliers;
  const bool is_confirmed = !others.empty() && (is_related || inliers >= kSumFactor * min_inliers);
  if (is_related && others.size() > 1) others.erase(others.begin() + 1, others.end());
  if (is_confirmed) {
    for (const std::size_t i : others) {
      if (std::exchange(loops[i].outcome, LoopOutcome::kAccepted) == LoopOutcome::kAccepted) {
        continue;
      }
      accepted.push_back(loops[i]);
    }
    loop.outcome = LoopOutcome::kAccepted;
    accepted.push_back(loop);
  }
  pending_.push_back(loops.size() - 1);
  graph.add_edges(accepted);
  return accepted;
}

}  // namespace mms
