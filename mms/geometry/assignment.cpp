#include "mms/geometry/assignment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mms {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kNone = -1;

/// Cost matrix with at least as many columns as rows. Infinite costs become a finite cost above
/// that of any feasible assignment.
Eigen::MatrixXd finite_costs(const Eigen::MatrixXd& cost) {
  double sum = 1.0;
  for (const double value : cost.reshaped()) sum += std::isfinite(value) ? value : 0.0;
  const Eigen::Index columns = std::max(cost.rows(), cost.cols());
  Eigen::MatrixXd finite = Eigen::MatrixXd::Constant(cost.rows(), columns, sum);
  finite.leftCols(cost.cols()) =
      cost.unaryExpr([sum](double value) { return std::isfinite(value) ? value : sum; });
  return finite;
}

/// Assigns row by row along shortest augmenting paths.
class AugmentingPaths {
 public:
  explicit AugmentingPaths(const Eigen::MatrixXd& cost)
      : cost_(cost),
        row_price_(Eigen::VectorXd::Zero(cost.rows())),
        column_price_(Eigen::VectorXd::Zero(cost.cols())),
        row_of_(static_cast<std::size_t>(cost.cols()), kNone) {
    for (int row = 0; row < cost.rows(); ++row) add(row);
  }

  /// Row assigned to every column.
  const std::vector<int>& row_of() const { return row_of_; }

 private:
  void add(int row) {
    const auto columns = static_cast<std::size_t>(cost_.cols());
    std::vector<double> distance(columns, kInfinity);
    std::vector<int> before(columns, kNone);  // previous column on the path
    std::vector<bool> done(columns, false);
    int last = kNone;
    int current = row;
    double reached = 0.0;
    while (current != kNone) {
      const int from = last;
      double least = kInfinity;
      for (int c = 0; c < cost_.cols(); ++c) {
        const auto i = static_cast<std::size_t>(c);
        if (done[i]) continue;
        const double through = reached + cost_(current, c) - row_price_[current] - column_price_[c];
        if (through < distance[i]) {
          distance[i] = through;
          before[i] = from;
        }
        if (distance[i] < least) {
          least = distance[i];
          last = c;
        }
      }
      reached = least;
      done[static_cast<std::size_t>(last)] = true;
      current = row_of_[static_cast<std::size_t>(last)];
    }
    update_prices(row, reached, distance, done);
    change_along(row, last, before);
  }

  void update_prices(int row, double reached, const std::vector<double>& distance,
                     const std::vector<bool>& done) {
    row_price_[row] += reached;
    for (int c = 0; c < cost_.cols(); ++c) {
      const auto i = static_cast<std::size_t>(c);
      if (!done[i]) continue;
      const double saved = reached - distance[i];
      column_price_[c] -= saved;
      if (row_of_[i] != kNone) row_price_[row_of_[i]] += saved;
    }
  }

  void change_along(int row, int last, const std::vector<int>& before) {
    for (int c = last; c != kNone; c = before[static_cast<std::size_t>(c)]) {
      const int previous = before[static_cast<std::size_t>(c)];
      row_of_[static_cast<std::size_t>(c)] =
          previous == kNone ? row : row_of_[static_cast<std::size_t>(previous)];
    }
  }

  const Eigen::MatrixXd& cost_;
  Eigen::VectorXd row_price_;
  Eigen::VectorXd column_price_;
  std::vector<int> row_of_;
};

}  // namespace

std::vector<int> assign_least_cost(const Eigen::MatrixXd& cost) {
  std::vector<int> column_of(static_cast<std::size_t>(cost.rows()), kNone);
  if (cost.size() == 0) return column_of;
  const Eigen::MatrixXd finite = finite_costs(cost);
  const AugmentingPaths paths(finite);
  for (int c = 0; c < cost.cols(); ++c) {
    const int row = paths.row_of()[static_cast<std::size_t>(c)];
    if (row != kNone && std::isfinite(cost(row, c))) column_of[static_cast<std::size_t>(row)] = c;
  }
  return column_of;
}

}  // namespace mms
