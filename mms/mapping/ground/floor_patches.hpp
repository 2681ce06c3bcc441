#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/mapping/static_map/map_cloud.hpp"

namespace mms {

/// A small flat piece of a map's surface.
struct FloorPatch {
  Eigen::Vector3d mean;    ///< world frame [m]
  Eigen::Vector3d normal;  ///< unit, upwards
};

/// [m]: side of a patch. Source: noise of 2 cm tilts one of six points by four degrees, and small
/// rooms still have dozens.
constexpr double kPatchSize = 0.4;

/// The flat pieces of the map, one a voxel of `kPatchSize`, whose normals have at least the cosine
/// `min_cosine` with `up`. Surfaces seen from below (ceilings) are excluded.
std::vector<FloorPatch> floor_patches(const MapCloud& map, const Eigen::Vector3d& up,
                                      double min_cosine);

}  // namespace mms
