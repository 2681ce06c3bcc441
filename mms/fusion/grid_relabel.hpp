#pragma once

#include "mms/core/labeled_cloud.hpp"
#include "mms/fusion/dynamic_objects.hpp"
#include "mms/fusion/fusion_config.hpp"
#include "mms/fusion/grid_nodes.hpp"
#include "mms/fusion/grid_planes.hpp"
#include "mms/fusion/mask_image.hpp"
#include "mms/fusion/nodes.hpp"

namespace mms {

/// Carries the dynamic objects of the nodes over to the points of an organised cloud (III-B.2): a
/// point within the relabel radius of a dynamic cluster is dynamic, unless it is on a removed plane
/// and off the mask. Every other one is static, whatever the mask says, unless it is masked and so
/// far from anything that no cluster holds it.
void relabel_grid(const NodeGrid& grid, const Nodes& nodes, const GridPlanes& planes,
                  const DynamicObjects& objects, const MaskImage& mask, const FusionConfig& config,
                  LabeledCloud& cloud);

}  // namespace mms
