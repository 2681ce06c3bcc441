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
  int instance = 0;         ///< index of the mask that gives its class
  Eigen::AlignedBox3f box;  ///< of its nodes without stray ones [m]
  bool is_sparse = false;   ///< loose nodes of a scan under one mask
};

/// True for boxes that one object of the size can fill.
bool fits(const Eigen::AlignedBox3f& box, const ObjectSize& size);

struct DynamicParts {
  std::vector<DynamicPart> parts;
  /// Masked nodes in no cluster: too few, apart from others. Of a scan, those under one mask that
  /// fit its size, without those far behind them, are a part, too.
  std::vector<std::size_t> loose;
};

/// Finds the dynamic parts among the nodes off the removed planes (III-B.2), in three steps:
/// 1. a cluster with at least `dynamic_share` labelled nodes is dynamic (the paper's 90 % rule);
/// 2. clusters that masks cover in part are divided into continuous surfaces; one of the size of an
///    object of which at least `partial_share` is labelled is dynamic as a whole (partial mask);
/// 3. of clusters that are still mixed (a person beside furniture) the pieces under the masks are
///    dynamic, unless they are background under an inaccurate or late mask: with little of the
///    instance, and continued beyond the mask along its boundary.
/// Parts that several masks cover are then divided among them (part_division.hpp).
DynamicParts find_dynamic_parts(const Nodes& nodes, const std::vector<Instance>& instances,
                                const FusionConfig& config);

}  // namespace mms
