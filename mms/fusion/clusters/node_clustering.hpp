#pragma once

#include <cstdint>
#include <vector>

#include "mms/fusion/clouds/nodes.hpp"
#include "mms/fusion/config/fusion_config.hpp"
#include "mms/geometry/clustering.hpp"

namespace mms {

/// How far apart linked nodes may be, see `FusionConfig`.
enum class Gap {
  kCoarse,  ///< `cluster_tolerance`: parts of one object, and points close to it
  kFine,    ///< `fine_tolerance`: one continuous surface (of LiDAR nodes: as kCoarse)
};

/// Euclidean clusters of the nodes with non-zero `keep` (III-B.2): on the grid for organised nodes,
/// where the gap grows with the depth noise, else in space.
Clusters cluster_nodes(const Nodes& nodes, const std::vector<std::uint8_t>& keep, Gap gap,
                       const FusionConfig& config);

/// Of every cluster the number of nodes beside and within `gap` of a node that is in no cluster but
/// in `source` (non-zero). Zero for nodes that are not organised.
std::vector<int> count_contacts(const Nodes& nodes, const Clusters& clusters,
                                const std::vector<std::uint8_t>& source, Gap gap,
                                const FusionConfig& config);

}  // namespace mms
