#pragma once

#include <Eigen/Core>

#include "mms/mapping/static_map/surface_voxels.hpp"

namespace mms {

/// Unit normal of the plane through the voxel's mean and those of its 26 neighbours, on the side of
/// `viewpoint` (world frame [m]); zero where they span no plane.
Eigen::Vector3f neighbourhood_normal(const VoxelGrid& grid, const VoxelBlock& block,
                                     const Voxel& voxel, const Eigen::Vector3f& viewpoint);

}  // namespace mms
