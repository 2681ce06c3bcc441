#include "mms/global_map/graph/pose_graph.hpp"

#include <ceres/autodiff_cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <iterator>
#include <memory>

namespace mms {
namespace {

/// [-]: standard deviations of a loop from which on its weight falls. Source: Huber's 1.345 for one
/// residual; a loop has six.
constexpr double kRobustScale = 3.0;

/// [-]: most iterations. Source: graphs of 1,000 nodes need less than 20.
constexpr int kMaxIterations = 50;

/// Optimized pose of a node.
struct PoseState {
  Eigen::Quaterniond rotation;
  Eigen::Vector3d position;
};

/// Root of a symmetric matrix that may be singular: R^T R is the matrix.
Matrix6d root_of(const Matrix6d& information) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information);
  return eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().transpose();
}

/// Residual of an edge: the small motion from the measured to the estimated pose of `b`.
struct EdgeResidual {
  Eigen::Quaterniond rotation;  // measured, inverse
  Eigen::Vector3d translation;  // measured
  Matrix6d root;

  template <class T>
  bool operator()(const T* rotation_a, const T* position_a, const T* rotation_b,
                  const T* position_b, T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    using Quaternion = Eigen::Quaternion<T>;
    const Eigen::Map<const Quaternion> q_a(rotation_a);
    const Eigen::Map<const Quaternion> q_b(rotation_b);
    const Eigen::Map<const Vector3> p_a(position_a);
    const Eigen::Map<const Vector3> p_b(position_b);
    const Quaternion q_measured = rotation.cast<T>();
    Eigen::Matrix<T, 6, 1> error;
    const Vector3 moved = q_a.conjugate() * (p_b - p_a) - translation.cast<T>();
    error.template head<3>() = q_measured * moved;
    // Of both signs of a quaternion, that of the small rotation.
    const Quaternion q_error = q_measured * (q_a.conjugate() * q_b);
    error.template tail<3>() = T(q_error.w() < T(0.0) ? -2.0 : 2.0) * q_error.vec();
    Eigen::Map<Eigen::Matrix<T, 6, 1>> weighted(residual);
    weighted = root.cast<T>() * error;
    return true;
  }
};

ceres::CostFunction* cost_of(const PoseEdge& edge) {
  const Eigen::Quaterniond rotation(edge.T_a_b.linear());
  return new ceres::AutoDiffCostFunction<EdgeResidual, 6, 4, 3, 4, 3>(
      new EdgeResidual{rotation.conjugate(), edge.T_a_b.translation(), root_of(edge.information)});
}

Eigen::Isometry3d pose_of(const PoseState& state) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = state.rotation.normalized().toRotationMatrix();
  pose.translation() = state.position;
  return pose;
}

}  // namespace

double squared_deviation(const PoseEdge& edge, const Eigen::Isometry3d& T_a_b) {
  const Vector6d error = se3::log(edge.T_a_b.inverse() * T_a_b);
  return error.dot(edge.information * error);
}

void PoseGraph::add_node(const Eigen::Isometry3d& motion, const Matrix6d& information,
                         bool begins_chain) {
  const std::size_t last = poses_.size() - 1;
  poses_.push_back(poses_[last] * motion);
  edges_.push_back({last, last + 1, motion, information});
  if (begins_chain) {
    ChainNode node;
    node.first = last + 1;
    chain_.push_back(node);
    return;
  }
  ChainNode node = chain_.back();
  node.T_first_node = node.T_first_node * motion;
  const Matrix6d moved = se3::adjoint(node.T_first_node);
  node.covariance += moved * information.inverse() * moved.transpose();
  chain_.push_back(node);
}

void PoseGraph::move(std::size_t first, std::size_t end, const Eigen::Isometry3d& T) {
  for (std::size_t i = first; i < end; ++i) poses_[i] = T * poses_[i];
}

Matrix6d PoseGraph::chain_covariance(std::size_t first, std::size_t last) const {
  assert(first <= last && chain_[first].first == chain_[last].first);
  // What the edges between them add, seen from the last node.
  const Matrix6d moved = se3::adjoint(chain_[last].T_first_node.inverse());
  return moved * (chain_[last].covariance - chain_[first].covariance) * moved.transpose();
}

std::vector<PoseEdge> PoseGraph::solve() {
  std::vector<PoseEdge> removed;
  while (!loops_.empty()) {
    minimize();
    const auto deviation = [&](const PoseEdge& loop) {
      return squared_deviation(loop, poses_[loop.a].inverse() * poses_[loop.b]);
    };
    const auto worst = std::max_element(
        loops_.begin(), loops_.end(),
        [&](const PoseEdge& a, const PoseEdge& b) { return deviation(a) < deviation(b); });
    if (deviation(*worst) <= kMaxSquaredDeviation) return removed;
    removed.push_back(*worst);
    loops_.erase(worst);
  }
  if (!removed.empty()) minimize();
  return removed;
}

void PoseGraph::minimize() {
  std::vector<PoseState> states;
  for (const Eigen::Isometry3d& pose : poses_) {
    states.push_back({Eigen::Quaterniond(pose.linear()), pose.translation()});
  }
  ceres::Problem problem;
  ceres::EigenQuaternionManifold* manifold = new ceres::EigenQuaternionManifold;
  const auto add = [&](const PoseEdge& edge, auto make_loss) {
    if (edge.a < fixed_ && edge.b < fixed_) return;
    PoseState& a = states[edge.a];
    PoseState& b = states[edge.b];
    problem.AddResidualBlock(cost_of(edge), make_loss(), a.rotation.coeffs().data(),
                             a.position.data(), b.rotation.coeffs().data(), b.position.data());
  };
  for (PoseState& state : states) {
    problem.AddParameterBlock(state.rotation.coeffs().data(), 4, manifold);
    problem.AddParameterBlock(state.position.data(), 3);
  }
  for (const PoseEdge& edge : edges_) add(edge, [] { return nullptr; });
  for (const PoseEdge& loop : loops_) add(loop, [] { return new ceres::HuberLoss(kRobustScale); });
  for (std::size_t i = 0; i < std::min(fixed_, states.size()); ++i) {
    problem.SetParameterBlockConstant(states[i].rotation.coeffs().data());
    problem.SetParameterBlockConstant(states[i].position.data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.num_threads = 1;
  options.max_num_iterations = kMaxIterations;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (std::size_t i = fixed_; i < poses_.size(); ++i) poses_[i] = pose_of(states[i]);
}

}  // namespace mms
