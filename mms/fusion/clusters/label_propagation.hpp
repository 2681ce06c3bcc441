#pragma once

#include <vector>

#include "mms/fusion/clouds/nodes.hpp"

namespace mms {

/// For every node of an organised grid a close labelled node (its "seed"), found in two passes over
/// the grid in which a node takes over the seed of a neighbour when it is the nearest in 3-D; a
/// node without a point takes over any. Exact where the path to the nearest seed lies on one
/// surface.
/// @param label  negative for nodes that are no seeds
/// @param reach         distance up to which seeds matter, before noise [m]
/// @param noise_factor  sigmas of the node's noise added to it
/// @return index of the seed, -1 where none is within reach
std::vector<int> nearest_seeds(const Nodes& nodes, const std::vector<int>& label, float reach,
                               float noise_factor);

}  // namespace mms
