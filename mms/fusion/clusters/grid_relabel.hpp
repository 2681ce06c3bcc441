#pragma once

#include "mms/core/labeled_cloud.hpp"
#include "mms/fusion/clouds/grid_nodes.hpp"
#include "mms/fusion/clouds/mask_image.hpp"
#include "mms/fusion/clouds/nodes.hpp"
#include "mms/fusion/clusters/dynamic_objects.hpp"
#include "mms/fusion/config/fusion_config.hpp"
#include "mms/fusion/planes/grid_planes.hpp"

namespace mms {

/// Transfers the dynamic objects of the nodes to the points of an organised cloud (III-B.2): a
/// point within the relabel radius of a dynamic cluster is dynamic, unless it is on a removed plane
/// and outside the mask. Every other point is static, also under a mask, unless it is masked and
/// its node is in no cluster.
void relabel_grid(const NodeGrid& grid, const Nodes& nodes, const GridPlanes& planes,
                  const DynamicObjects& objects, const MaskImage& mask, const FusionConfig& config,
                  LabeledCloud& cloud);

}  // namespace mms
