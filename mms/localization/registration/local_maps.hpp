#pragma once

#include "mms/geometry/voxels/point_map.hpp"
#include "mms/localization/features/feature_cloud.hpp"
#include "mms/localization/registration/surface_map.hpp"

namespace mms {

/// How features find their counterpart in the local maps.
enum class Association {
  kPaper,    ///< eqs. (3), (4): line through 2, plane through 3 nearest map points
  kSurface,  ///< planes: mean and normal of a voxel; edges: principal line of the neighborhood
};

/// The local edge and plane maps of III-C in the world frame.
struct LocalMaps {
  PointMap edges;
  PointMap plane_points;  ///< filled for the paper's association
  SurfaceMap surfaces;    ///< filled for the surface association

  /// @param voxel_size  [m]
  /// @param max_voxels  bound on the voxels of each map
  LocalMaps(double voxel_size, std::size_t max_voxels);

  void insert(const FeatureCloud& features, const Eigen::Isometry3d& T_world_sensor,
              Association association);
  /// The same points and surfaces with other voxels.
  LocalMaps resized(double voxel_size, std::size_t max_voxels) const;

  void remove_farther_than(const Eigen::Vector3f& centre, float distance);

  float voxel_size() const { return surfaces.voxel_size(); }
};

}  // namespace mms
