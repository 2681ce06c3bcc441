#include "mms/geometry/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mms/core/random_stream.hpp"

namespace mms {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Total {
  int pairs = 0;
  double cost = 0.0;
};

Total total(const Eigen::MatrixXd& cost, const std::vector<int>& column_of) {
  Total sum;
  for (std::size_t row = 0; row < column_of.size(); ++row) {
    if (column_of[row] < 0) continue;
    ++sum.pairs;
    sum.cost += cost(static_cast<Eigen::Index>(row), column_of[row]);
  }
  return sum;
}

/// Tries every permutation of the columns, padded with rows without a column.
Total exhaustive_search(const Eigen::MatrixXd& cost) {
  std::vector<int> order(static_cast<std::size_t>(cost.rows() + cost.cols()));
  std::iota(order.begin(), order.end(), 0);
  Total best;
  do {
    std::vector<int> column_of(static_cast<std::size_t>(cost.rows()), -1);
    for (std::size_t row = 0; row < column_of.size(); ++row) {
      const int column = order[row];
      const bool is_column = column < cost.cols();
      if (is_column && std::isfinite(cost(static_cast<Eigen::Index>(row), column)))
        column_of[row] = column;
    }
    const Total sum = total(cost, column_of);
    if (sum.pairs > best.pairs || (sum.pairs == best.pairs && sum.cost < best.cost)) best = sum;
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(Assignment, MinimizesTotalCost) {
  Eigen::MatrixXd cost(2, 2);
  cost << 1.0, 2.0, 1.5, 9.0;
  EXPECT_EQ(assign_least_cost(cost), (std::vector<int>{1, 0}));
}

TEST(Assignment, OmitsInfiniteCosts) {
  Eigen::MatrixXd cost(3, 2);
  cost << kInfinite, 0.5, kInfinite, kInfinite, kInfinite, 0.2;
  EXPECT_EQ(assign_least_cost(cost), (std::vector<int>{-1, -1, 1}));
}

TEST(Assignment, EmptyMatrixGivesNoPairs) {
  EXPECT_TRUE(assign_least_cost(Eigen::MatrixXd(0, 3)).empty());
  EXPECT_EQ(assign_least_cost(Eigen::MatrixXd(2, 0)), (std::vector<int>{-1, -1}));
}

TEST(Assignment, EqualsExhaustiveSearch) {
  RandomStream random(7);
  for (int trial = 0; trial < 150; ++trial) {
    const auto rows = static_cast<Eigen::Index>(1 + trial % 4);
    const auto columns = static_cast<Eigen::Index>(1 + (trial / 4) % 4);
    Eigen::MatrixXd cost(rows, columns);
    for (double& value : cost.reshaped()) {
      value = random.uniform() < 0.3 ? kInfinite : random.uniform();
    }
    const Total found = total(cost, assign_least_cost(cost));
    const Total best = exhaustive_search(cost);
    EXPECT_EQ(found.pairs, best.pairs) << cost;
    EXPECT_NEAR(found.cost, best.cost, 1e-12) << cost;
  }
}

}  // namespace
}  // namespace mms
