#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "mms/core/segmentation.hpp"
#include "mms/fusion/clouds/nodes.hpp"
#include "mms/fusion/config/fusion_config.hpp"

namespace mms {

/// A dynamic cluster or the dynamic piece of one.
struct DynamicPart {
  std::vector<std::size_t> nodes;
  int instance = 0;         ///< index of the mask that says what it is
  Eigen::AlignedBox3f box;  ///< of its nodes without stray ones [m]
};

/// True for boxes that one object of the size can fill.
bool fits(const Eigen::AlignedBox3f& box, const ObjectSize& size);

struct DynamicParts {
  std::vector<DynamicPart> parts;
  std::vector<std::size_t> loose;  ///< masked nodes in no cluster: they lie apart, and are too few
};

/// Finds what is dynamic among the nodes off the removed planes (III-B.2), in three steps:
/// 1. a cluster with at least `dynamic_share` labelled nodes is dynamic (the paper's 90 % rule);
/// 2. clusters that masks cover in part are divided into continuous surfaces; one of the size of an
///    object of which at least `partial_share` is labelled is dynamic wholly (half a mask);
/// 3. of what is still mixed (a person merged with furniture) the pieces under the masks are
///    dynamic, unless they look like the background of a sloppy or late mask: holding little of the
///    instance and running on beyond the mask all along its boundary.
/// What several masks cover is then divided among them (part_division.hpp).
DynamicParts find_dynamic_parts(const Nodes& nodes, const std::vector<Instance>& instances,
                                const FusionConfig& config);

}  // namespace mms
