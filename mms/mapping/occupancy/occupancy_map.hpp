#pragma once

#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/occupancy/keyframe_marks.hpp"
#include "mms/mapping/occupancy/occupancy_blocks.hpp"
#include "mms/mapping/occupancy/occupancy_config.hpp"
#include "mms/mapping/static_map/surface_points.hpp"

namespace mms {

/// Free, occupied and unknown space in voxels of the world frame, as OctoMap keeps it (Hornung et
/// al., 2013): clamped log odds, a keyframe's hits at its static points, misses along the rays
/// to its points. Rays to people and vehicles free the space before them and hit nothing, so that a
/// person who walks through a room leaves no obstacle.
///
/// A voxel that a keyframe hits is not freed by the same keyframe, and rays end short of their
/// points, so that rays at grazing angles do not free a wall. One ray a voxel is followed: the cost
/// of a keyframe depends on its view, not on the length of the run. Rays of a scan are followed
/// from their points to the sensor and end where others freed the space already (as the fast
/// integrator of Voxblox, Oleynikova et al., IROS 2017): most of them share the voxels near the
/// sensor.
class OccupancyMap {
 public:
  /// @param surface  selects the points of a depth image that make hits; the noise of all points
  explicit OccupancyMap(const OccupancyConfig& config = {}, const SurfaceConfig& surface = {});

  /// Adds a keyframe. A pose that is not finite, or too far for voxels to be numbered, changes
  /// nothing; nor does any keyframe where the map is not `enabled`.
  void integrate(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor);

  /// @param point  world frame [m]
  Occupancy at(const Eigen::Vector3d& point) const;

  /// State of a voxel by its key in the world frame.
  Occupancy at(const VoxelKey& key) const { return occupancy_of(blocks_.log_odds(key)); }

  const OccupancyBlocks& blocks() const { return blocks_; }
  const OccupancyConfig& config() const { return config_; }
  double voxel_size() const { return blocks_.voxel_size(); }  ///< current one [m]

 private:
  void mark_scan(const LabeledCloud& cloud, const Eigen::Isometry3f& T_world_sensor,
                 KeyframeMarks& marks) const;
  void mark_hits(const LabeledCloud& cloud, const Eigen::Isometry3f& T_world_sensor, int step,
                 KeyframeMarks& marks) const;
  void mark_rays(const LabeledCloud& cloud, const Eigen::Isometry3f& T_world_sensor, int step,
                 KeyframeMarks& marks) const;
  void mark_depth_ray(const Eigen::Vector3f& target, const Eigen::Isometry3f& T_world_sensor,
                      KeyframeMarks& marks) const;
  void mark_scan_ray(const Eigen::Vector3f& target, const Eigen::Isometry3f& T_world_sensor,
                     KeyframeMarks& marks) const;
  void apply();
  void keep_to_budget();
  int step_of(const LabeledCloud& cloud) const;
  Eigen::Vector3f reach(const Eigen::Vector3f& point) const;

  OccupancyConfig config_;
  SurfaceConfig surface_;
  OccupancyBlocks blocks_;
  std::uint32_t keyframes_ = 0;
  std::vector<BlockMarks> marks_;  // of the last keyframe
};

}  // namespace mms
