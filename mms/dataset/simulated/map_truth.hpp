#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mms/core/transform.hpp"
#include "mms/geometry/camera.hpp"
#include "mms/geometry/voxels/voxel_hash_map.hpp"
#include "mms/simulation/simulated_scene.hpp"
#include "mms/simulation/truth/truth_cloud.hpp"

namespace mms {

/// Ground-truth map of a simulated sensor: the exact points of all returns in the world frame,
/// labeled static or with their object; moving objects appear at all their observed positions. One
/// point per voxel and label.
class MapTruth {
 public:
  /// @param voxel_size  [m], > 0
  /// @param stride      of the pixels used, >= 1
  explicit MapTruth(double voxel_size = 0.04, int stride = 2);

  /// Adds the returns of a depth camera or LiDAR: the exact points, without noise.
  void add(const SimulatedFrame& frame, const Transform<World, Sensor>& T_world_sensor);

  /// Adds a point in the world frame [m] with its label: 0 static, else 1 + id of the object.
  void add(const Eigen::Vector3f& point, std::int32_t label);

  /// Static points first, then by object, each in order of first observation.
  TruthCloud cloud() const;

 private:
  const std::vector<Eigen::Vector3f>& rays_of(const CameraIntrinsics& camera);

  using Points = VoxelHashMap<Eigen::Vector3f>;
  double voxel_size_;
  int stride_;
  std::map<std::int32_t, Points> points_;  ///< by label
  CameraIntrinsics camera_;                ///< camera of `rays_`
  std::vector<Eigen::Vector3f> rays_;
};

}  // namespace mms
