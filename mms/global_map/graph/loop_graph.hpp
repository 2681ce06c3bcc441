#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mms/core/transform.hpp"
#include "mms/global_map/graph/pose_graph.hpp"
#include "mms/global_map/graph/session_groups.hpp"
#include "mms/global_map/keyframes/keyframe_record.hpp"
#include "mms/global_map/loops/loop.hpp"

namespace mms {

/// The keyframes of all sessions as nodes of a pose graph, and the loops between them.
class LoopGraph {
 public:
  /// @param min_path  least length of the path between the ends of a loop [m]
  explicit LoopGraph(double min_path) : min_path_(min_path) {}

  /// Adds the next keyframe: of the session of the last one, or of the next.
  void add_node(const KeyframeRecord& record);

  /// Takes the solution and the loops of the nodes so far. The nodes that follow are a new session.
  /// @param poses  by node
  void restore(std::vector<Eigen::Isometry3d> poses, std::vector<Loop> loops);

  /// Keeps the poses of all nodes so far.
  void fix();

  /// Keeps a loop that was checked.
  /// @returns whether it is accepted so far
  bool add_check(Loop loop);

  /// Joins the sessions of accepted loops and adds these to the pose graph.
  void add_edges(const std::vector<Loop>& accepted);

  /// Solves the pose graph where such loops move it, and at times for the others.
  void solve_if_needed(const std::vector<Loop>& accepted);

  /// Solves for all loops that were not solved for.
  void finish();

  /// Covariance of the pose of a node relative to an earlier one, of a right perturbation of the
  /// later one, by the odometry and one loop, or one for each session on the way back in time;
  /// nothing where there is no such way.
  std::optional<Matrix6d> relative_covariance(std::size_t earlier, std::size_t later) const;

  /// The first node that the path since is too short for; the last one at the latest.
  /// @param path  its length [m]
  std::size_t first_recent(double path) const;

  /// Whether loops join a session to the first one, whose world is the frame of the map.
  bool is_joined(std::uint32_t session) const;

  /// Whether loops join the session of a node to the present one.
  bool shares_frame(std::size_t node) const {
    return sessions_.share_frame(sessions_.session_of(node), session_);
  }

  /// Whether loops join two sessions that have nodes.
  bool share_frame(std::uint32_t a, std::uint32_t b) const { return sessions_.share_frame(a, b); }

  /// Whether loops join the sessions of two nodes.
  bool are_in_one_frame(std::size_t a, std::size_t b) const {
    return share_frame(sessions_.session_of(a), sessions_.session_of(b));
  }

  bool is_fixed(std::size_t node) const { return node < fixed_; }

  std::size_t size() const { return path_.size(); }

  /// Number of the session of the nodes that are added.
  std::uint32_t session() const { return session_; }

  /// Corrected poses, by node; the identity before the first one.
  const std::vector<Eigen::Isometry3d>& poses() const { return graph_.poses(); }

  /// All that were checked, in order.
  const std::vector<Loop>& loops() const { return loops_; }
  std::vector<Loop>& loops() { return loops_; }

 private:
  void join(const Loop& loop);
  void solve();
  template <class IsSession>
  std::optional<Loop> last_loop(std::size_t later, const IsSession& is_earlier) const;
  std::optional<Matrix6d> covariance_between(std::size_t earlier, std::size_t later,
                                             std::size_t& links) const;
  std::optional<Matrix6d> covariance_by(const Loop& link, std::size_t earlier, std::size_t later,
                                        std::size_t& links) const;
  std::optional<Matrix6d> covariance_by_session(std::size_t earlier, std::size_t later,
                                                std::size_t& links) const;

  double min_path_;
  PoseGraph graph_;
  std::vector<double> path_;                 ///< length of the path up to each node [m]
  Transform<World, Sensor> T_world_sensor_;  ///< of the last node, by odometry
  std::uint32_t session_ = 0;
  SessionGroups sessions_;    // up to that of the last node
  std::size_t fixed_ = 0;     // first nodes that are not corrected
  std::size_t unsolved_ = 0;  // loops since the pose graph was solved
  std::vector<Loop> loops_;
};

}  // namespace mms
