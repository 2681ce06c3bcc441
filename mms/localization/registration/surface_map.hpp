#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mms/geometry/voxels/voxel_hash_map.hpp"
#include "mms/localization/features/feature_cloud.hpp"

namespace mms {

/// Local plane map: each voxel holds the mean point and mean normal of the planar features that
/// fell into it, weighted by their inverse variance. World frame.
class SurfaceMap {
 public:
  struct Surface {
    Eigen::Vector3f mean;
    Eigen::Vector3f normal;  ///< unit
    float sigma;             ///< standard deviation of the mean along the normal [m]
  };

  SurfaceMap(double voxel_size, std::size_t max_voxels) : voxels_(voxel_size, max_voxels) {}

  void insert(const std::vector<PlaneFeature>& planes, const Eigen::Isometry3d& T_world_sensor);

  /// Adds the surfaces of a map in the same frame.
  void insert(const SurfaceMap& other);

  /// The surface whose mean is nearest to `point` among those of its voxel and the 26 around it
  /// with a normal within 45 degrees of `normal`; nothing where there is none.
  std::optional<Surface> match(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const;

  void remove_farther_than(const Eigen::Vector3f& centre, float distance) {
    voxels_.remove_farther_than(centre, distance);
  }
  void clear() { voxels_.clear(); }
  float voxel_size() const { return voxels_.voxel_size(); }
  std::size_t size() const { return voxels_.size(); }
  bool empty() const { return voxels_.empty(); }

 private:
  struct Cell {
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< weighted sum of unit normals
    float weight = 0.0F;                               ///< sum of 1 / sigma^2 [1/m^2]
  };

  VoxelHashMap<Cell> voxels_;
};

}  // namespace mms
