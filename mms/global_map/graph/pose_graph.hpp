#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <utility>
#include <vector>

#include "mms/geometry/se3.hpp"

namespace mms {

/// A measured relative pose of two nodes.
struct PoseEdge {
  std::size_t a = 0;
  std::size_t b = 0;
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  /// Of the deviation of T_a_b by a right perturbation: translation [1/m^2], rotation [1/rad^2].
  Matrix6d information = Matrix6d::Identity();
};

/// [-]: squared deviation (`squared_deviation`) above which a relative pose is excluded.
/// Source: 99.9 % of the chi-square distribution with six degrees of freedom.
inline constexpr double kMaxSquaredDeviation = 22.5;

/// Poses of nodes that agree best with measured relative poses. Node 0 is fixed. Solved by Ceres in
/// one thread, so that equal edges give equal poses.
class PoseGraph {
 public:
  /// Adds the first node.
  explicit PoseGraph(const Eigen::Isometry3d& first = Eigen::Isometry3d::Identity())
      : poses_{first}, chain_(1) {}

  /// Adds a node after the last one, with an edge between them.
  /// @param motion       pose of the new node in the frame of the last one
  /// @param information  of `motion`, as that of `PoseEdge`
  /// @param begins_chain  whether the motion is not known: `chain_covariance` does not cross it
  void add_node(const Eigen::Isometry3d& motion, const Matrix6d& information,
                bool begins_chain = false);

  /// Moves nodes whose place relative to the others was unknown.
  /// @param first, end  of the nodes
  /// @param T           new frame of their poses from the old one
  void move(std::size_t first, std::size_t end, const Eigen::Isometry3d& T);

  /// Keeps the poses of the first nodes.
  void fix(std::size_t end) { fixed_ = end; }

  /// Sets all poses, as a solution of the same edges.
  /// @param poses  by node
  void set_poses(std::vector<Eigen::Isometry3d> poses) { poses_ = std::move(poses); }

  /// Adds an edge between earlier nodes, with a robust cost. To be solved for.
  void add_loop(const PoseEdge& loop) { loops_.push_back(loop); }

  /// Minimizes the squared deviations. A loop whose deviation stays above `kMaxSquaredDeviation` is
  /// removed, and the graph is solved again.
  /// @returns the loops that were removed
  std::vector<PoseEdge> solve();

  const std::vector<Eigen::Isometry3d>& poses() const { return poses_; }  ///< by node
  const std::vector<PoseEdge>& edges() const { return edges_; }           ///< of successive nodes
  const std::vector<PoseEdge>& loops() const { return loops_; }

  /// Covariance of the pose of a node relative to an earlier one by the edges between them, of a
  /// right perturbation of the later one. Takes the same time for any number of them.
  /// @param first, last  of one chain
  Matrix6d chain_covariance(std::size_t first, std::size_t last) const;

 private:
  /// A node relative to the first one of its chain, by the edges between them.
  struct ChainNode {
    std::size_t first = 0;
    Eigen::Isometry3d T_first_node = Eigen::Isometry3d::Identity();
    Matrix6d covariance = Matrix6d::Zero();  // of a left perturbation, as seen from `first`
  };

  void minimize();

  std::vector<Eigen::Isometry3d> poses_;
  std::vector<ChainNode> chain_;  // by node
  std::vector<PoseEdge> edges_;
  std::vector<PoseEdge> loops_;
  std::size_t fixed_ = 1;  ///< first nodes that do not move
};

/// Squared Mahalanobis distance of a relative pose from an edge's, in six degrees of freedom.
double squared_deviation(const PoseEdge& edge, const Eigen::Isometry3d& T_a_b);

}  // namespace mms
