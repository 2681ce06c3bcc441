#pragma once

#include <vector>

#include "mms/fusion/nodes.hpp"

namespace mms {

/// For every node of an organised grid a close labelled node (its "seed"), found in two passes over
/// the grid in which a node takes over the seed of a neighbour when it is the nearest in 3-D; a
/// node without a point takes over any. Exact where the way to the nearest seed lies on one
/// surface.
/// @param label  negative for nodes that are no seeds
/// @return index of the seed, -1 where none is within `reach` [m]
std::vector<int> nearest_seeds(const Nodes& nodes, const std::vector<int>& label, float reach);

}  // namespace mms
