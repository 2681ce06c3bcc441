#pragma once

#include <Eigen/Core>
#include <vector>

namespace mms {

/// Optimal assignment of rows to columns: as many pairs as possible, of least total cost (Kuhn
/// 1955; shortest augmenting paths as in Jonker and Volgenant, Computing 1987). Deterministic.
/// @returns the column of every row, -1 for unassigned rows
/// @param cost rows x columns, at least 0; infinite for forbidden pairs
std::vector<int> assign_least_cost(const Eigen::MatrixXd& cost);

}  // namespace mms
