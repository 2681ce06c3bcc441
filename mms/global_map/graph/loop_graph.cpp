#include "mms/global_map/graph/loop_graph.hpp"

#include <algorithm>
#include <utility>

#include "mms/global_map/graph/odometry_noise.hpp"

namespace mms {
namespace {

/// [1/m^2]: least information of a loop in a direction that its views do not determine. Source: a
/// standard deviation of 100 m, beyond every use.
constexpr double kMinInformation = 1e-4;

/// [-]: squared deviation of a loop up to which the pose graph is not solved for it alone.
/// Source: a fifth of a standard deviation in each of six directions.
constexpr double kSmallDeviation = 0.24;

/// [-]: loops after which it is solved in any case. Source: initial choice; about 5 m.
constexpr std::size_t kMaxUnsolved = 20;

/// [-]: last keyframes that move while a map is localized in. Source: initial choice, about 25 m;
/// loops to the map are much more frequent.
constexpr std::size_t kWindow = 100;

/// [-]: loops to other sessions that are followed to relate two of them. Source: computing time; a
/// way back in time has one for each session, and the last loops lead to most of them.
constexpr std::size_t kMaxLinks = 100;

/// Covariance of a right perturbation of a pose, of the pose after a motion from there.
Matrix6d carried(const Matrix6d& covariance, const Eigen::Isometry3d& motion) {
  const Matrix6d moved = se3::adjoint(motion.inverse());
  return moved * covariance * moved.transpose();
}

}  // namespace

void LoopGraph::add_node(const KeyframeRecord& record) {
  const bool is_new_session = record.session >= sessions_.size();
  session_ = record.session;
  const Eigen::Isometry3d last = std::exchange(T_world_sensor_, record.T_world_sensor).isometry();
  if (is_new_session) sessions_.add(size());
  if (path_.empty()) {
    graph_ = PoseGraph(record.T_world_sensor.isometry());
    path_.push_back(0.0);
    return;
  }
  if (is_new_session) {
    // Its world is that of the map until a loop shows where it is.
    graph_.add_node(graph_.poses().back().inverse() * record.T_world_sensor.isometry(),
                    unknown_motion_information(), true);
    path_.push_back(path_.back() + min_path_);
    return;
  }
  const Eigen::Isometry3d motion = last.inverse() * record.T_world_sensor.isometry();
  graph_.add_node(motion, odometry_information(motion, record.after_lost));
  // What was seen before the sensor was lost is not recent.
  const double length = motion.translation().norm() + (record.after_lost ? min_path_ : 0.0);
  path_.push_back(path_.back() + length);
}

void LoopGraph::restore(std::vector<Eigen::Isometry3d> poses, std::vector<Loop> loops) {
  if (!path_.empty()) graph_.set_poses(std::move(poses));
  loops_ = std::move(loops);
  for (const Loop& loop : loops_) {
    if (loop.outcome != LoopOutcome::kAccepted) continue;
    graph_.add_loop({loop.candidate, loop.query, loop.T_candidate_query, loop.information});
    sessions_.join(sessions_.session_of(loop.candidate), sessions_.session_of(loop.query));
  }
  session_ = sessions_.size();
}

void LoopGraph::fix() {
  fixed_ = size();
  graph_.fix(fixed_);
}

bool LoopGraph::add_check(Loop loop) {
  loops_.push_back(std::move(loop));
  return loops_.back().outcome == LoopOutcome::kAccepted;
}

void LoopGraph::add_edges(const std::vector<Loop>& accepted) {
  for (const Loop& loop : accepted) {
    join(loop);
    graph_.add_loop({loop.candidate, loop.query, loop.T_candidate_query, loop.information});
  }
}

void LoopGraph::solve_if_needed(const std::vector<Loop>& accepted) {
  unsolved_ += accepted.size();
  const bool moves = std::any_of(accepted.begin(), accepted.end(), [&](const Loop& loop) {
    const PoseEdge edge{loop.candidate, loop.query, loop.T_candidate_query, loop.information};
    const std::vector<Eigen::Isometry3d>& poses = graph_.poses();
    const Eigen::Isometry3d T = poses[loop.candidate].inverse() * poses[loop.query];
    return squared_deviation(edge, T) > kSmallDeviation;
  });
  if (moves || unsolved_ >= kMaxUnsolved) finish();
}

void LoopGraph::finish() {
  if (unsolved_ == 0) return;
  solve();
  unsolved_ = 0;
}

void LoopGraph::solve() {
  if (fixed_ > 0) graph_.fix(std::max(fixed_, size() - std::min(size(), kWindow)));
  for (const PoseEdge& removed : graph_.solve()) {
    for (Loop& loop : loops_) {
      if (loop.outcome == LoopOutcome::kAccepted && loop.candidate == removed.a &&
          loop.query == removed.b) {
        loop.outcome = LoopOutcome::kInconsistent;
      }
    }
  }
}

bool LoopGraph::is_joined(std::uint32_t session) const {
  return session < sessions_.size() && sessions_.group_of(session) == 0;
}

/// Moves the sessions that a loop joins to the others: the frame is that of the earliest session.
void LoopGraph::join(const Loop& loop) {
  const std::uint32_t earlier = sessions_.session_of(loop.candidate);
  const std::uint32_t later = sessions_.session_of(loop.query);
  const bool moves_later = sessions_.group_of(later) > sessions_.group_of(earlier);
  const std::uint32_t group = sessions_.group_of(moves_later ? later : earlier);
  const SessionGroups before = sessions_;
  if (!sessions_.join(earlier, later)) return;
  const std::vector<Eigen::Isometry3d>& poses = graph_.poses();
  const Eigen::Isometry3d by_loop =
      poses[loop.candidate] * loop.T_candidate_query * poses[loop.query].inverse();
  const Eigen::Isometry3d T = moves_later ? by_loop : by_loop.inverse();
  for (std::uint32_t session = 0; session < before.size(); ++session) {
    if (before.group_of(session) != group) continue;
    const auto [first, end] = before.range(session, poses.size());
    graph_.move(first, end, T);
  }
}

std::optional<Matrix6d> LoopGraph::relative_covariance(std::size_t earlier,
                                                       std::size_t later) const {
  if (!are_in_one_frame(earlier, later)) return std::nullopt;
  std::size_t links = kMaxLinks;
  return covariance_between(earlier, later, links);
}

/// @param links  that may still be followed: sessions of many days have very many to each other
std::optional<Matrix6d> LoopGraph::covariance_between(std::size_t earlier, std::size_t later,
                                                      std::size_t& links) const {
  const std::uint32_t from = sessions_.session_of(earlier);
  const std::uint32_t to = sessions_.session_of(later);
  const auto link = last_loop(later, [&](std::uint32_t session) { return session == from; });
  if (from != to) {
    return link ? covariance_by(*link, earlier, later, links)
                : covariance_by_session(earlier, later, links);
  }
  // The shorter way: along the path, or back by the last loop.
  const bool goes_by_loop = link && std::max(earlier, link->candidate) -
                                            std::min(earlier, link->candidate) + later -
                                            link->query <
                                        later - earlier;
  const Matrix6d chain = graph_.chain_covariance(earlier, later);
  if (!goes_by_loop) return chain;
  // The views of a loop may not determine a direction, as that along a corridor.
  const auto largest = [](const Matrix6d& covariance) {
    return covariance.topLeftCorner<3, 3>().diagonal().maxCoeff();
  };
  const std::optional<Matrix6d> by_loop = covariance_by(*link, earlier, later, links);
  return by_loop && largest(*by_loop) < largest(chain) ? by_loop : chain;
}

/// The last accepted loop from a node of such a session to one of the session of `later`, up to it.
template <class IsSession>
std::optional<Loop> LoopGraph::last_loop(std::size_t later, const IsSession& is_earlier) const {
  const std::uint32_t session = sessions_.session_of(later);
  const auto found = std::find_if(loops_.rbegin(), loops_.rend(), [&](const Loop& loop) {
    return loop.outcome == LoopOutcome::kAccepted && loop.query <= later &&
           sessions_.session_of(loop.query) == session &&
           is_earlier(sessions_.session_of(loop.candidate));
  });
  if (found == loops_.rend()) return std::nullopt;
  return *found;
}

/// From `earlier` along the path to a loop's earlier end, by the loop, and along the path.
std::optional<Matrix6d> LoopGraph::covariance_by(const Loop& link, std::size_t earlier,
                                                 std::size_t later, std::size_t& links) const {
  const std::vector<Eigen::Isometry3d>& poses = graph_.poses();
  const bool is_forward = earlier <= link.candidate;
  std::optional<Matrix6d> covariance = is_forward
                                           ? covariance_between(earlier, link.candidate, links)
                                           : covariance_between(link.candidate, earlier, links);
  if (!covariance) return std::nullopt;
  if (!is_forward) {
    *covariance = carried(*covariance, poses[earlier].inverse() * poses[link.candidate]);
  }
  *covariance = carried(*covariance, link.T_candidate_query) +
                (link.information + kMinInformation * Matrix6d::Identity()).inverse();
  return carried(*covariance, poses[link.query].inverse() * poses[later]) +
         graph_.chain_covariance(link.query, later);
}

/// By loops to other sessions than that of `earlier`, and from these on.
std::optional<Matrix6d> LoopGraph::covariance_by_session(std::size_t earlier, std::size_t later,
                                                         std::size_t& links) const {
  std::vector<std::uint32_t> tried = {sessions_.session_of(earlier), sessions_.session_of(later)};
  const auto is_new = [&](std::uint32_t session) {
    return std::find(tried.begin(), tried.end(), session) == tried.end();
  };
  while (links > 0) {
    const std::optional<Loop> link = last_loop(later, is_new);
    if (!link) return std::nullopt;
    --links;
    if (auto covariance = covariance_by(*link, earlier, later, links)) return covariance;
    tried.push_back(sessions_.session_of(link->candidate));
  }
  return std::nullopt;
}

std::size_t LoopGraph::first_recent(double path) const {
  const auto recent = std::upper_bound(path_.begin(), path_.end(), path_.back() - path);
  return std::min(static_cast<std::size_t>(recent - path_.begin()), size() - 1);
}

}  // namespace mms
