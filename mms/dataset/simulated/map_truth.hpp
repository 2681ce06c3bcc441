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

/// The true map of what a simulated sensor has looked at: the exact points, in the world frame, of
/// all that it got a return from, each labelled as static or with the object it lies on; things
/// that move are kept at every place they were seen at. One point a voxel and label.
class MapTruth {
 public:
  /// @param voxel_size  [m], > 0
  /// @param stride      of the pixels taken, >= 1
  explicit MapTruth(double voxel_size = 0.04, int stride = 2);

  /// Adds what a depth camera or LiDAR got a return from: the exact point, not the measured one.
  void add(const SimulatedFrame& frame, const Transform<World, Sensor>& T_world_sensor);

  /// Adds a point in the world frame [m] with its label: 0 static, else 1 + id of the object.
  void add(const Eigen::Vector3f& point, std::int32_t label);

  /// Static points first, then object by object; in the order they were first seen in.
  TruthCloud cloud() const;

 private:
  const std::vector<Eigen::Vector3f>& rays_of(const CameraIntrinsics& camera);

  using Points = VoxelHashMap<Eigen::Vector3f>;
  double voxel_size_;
  int stride_;
  std::map<std::int32_t, Points> points_;  ///< by label
  CameraIntrinsics camera_;                ///< that `rays_` belong to
  std::vector<Eigen::Vector3f> rays_;
};

}  // namespace mms
