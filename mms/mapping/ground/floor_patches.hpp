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

constexpr double kPatchSize = 0.4;  ///< [m]

/// The flat pieces of the map, one a voxel of `kPatchSize`, that face upwards within an angle of
/// `up` that has the cosine `min_cosine`. Surfaces seen from below (ceilings) are none.
std::vector<FloorPatch> floor_patches(const MapCloud& map, const Eigen::Vector3d& up,
                                      double min_cosine);

}  // namespace mms
