#pragma once

#include <vector>

#include "mms/fusion/clouds/nodes.hpp"
#include "mms/geometry/clustering.hpp"

namespace mms {

/// How the nodes of one cluster are labelled by the masks.
struct ClusterVote {
  int nodes = 0;
  int labelled = 0;           ///< under a dilated mask
  int raw = 0;                ///< under a mask as segmented
  int instance = -1;          ///< index of the mask with most of them, -1 for none
  double instance_share = 0;  ///< share of that mask's nodes off the planes that the cluster holds
};

/// Counts the votes of every cluster; the mask as segmented decides which instance a cluster is.
std::vector<ClusterVote> count_votes(const Nodes& nodes, const Clusters& clusters,
                                     std::size_t instance_count);

}  // namespace mms
