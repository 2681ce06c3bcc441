#pragma once

#include <Eigen/Core>
#include <vector>

namespace mms {

/// The column each row is given to so that as many rows as possible have one, no column is given
/// twice, and the costs add up to the least (Kuhn 1955; by shortest augmenting paths, as in Jonker
/// and Volgenant, Computing 1987). -1 for rows without one. Of equal solutions always the same.
/// @param cost  rows x columns, at least 0; infinite for pairs that are ruled out
std::vector<int> assign_least_cost(const Eigen::MatrixXd& cost);

}  // namespace mms
