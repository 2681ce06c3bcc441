#pragma once

#include <cstdint>
#include <vector>

#include "mms/fusion/clouds/nodes.hpp"
#include "mms/fusion/config/fusion_config.hpp"
#include "mms/geometry/plane_segmentation.hpp"

namespace mms {

/// The large planes of an organised cloud, and where in the grid each of them is seen. A plane is
/// infinite, the surface is not: a desk's plane intersects a standing person at the hips, but no
/// cell there faces upwards.
struct GridPlanes {
  std::vector<Plane> planes;
  std::vector<std::uint8_t> seen;  ///< bit k set at and beside the nodes that lie on plane k
};

/// Finds the large planes of organised `nodes` (`Nodes::on_plane` is not read).
GridPlanes find_grid_planes(const Nodes& nodes, const PlaneRemoval& config);

/// True where `point`, in the cell of node `node`, is on a plane within `tolerance` [m].
bool is_on_plane(const GridPlanes& planes, std::size_t node, const Eigen::Vector3f& point,
                 float tolerance);

}  // namespace mms
