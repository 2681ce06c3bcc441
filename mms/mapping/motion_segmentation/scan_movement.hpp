#pragma once

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/free_space/scan_free_space.hpp"
#include "mms/mapping/motion_segmentation/movement_config.hpp"
#include "mms/mapping/motion_segmentation/view_memory.hpp"

namespace mms {

/// What `Movement` is for organised clouds, for LiDAR scans: finds what moves without a name, in
/// all directions, where most have no camera and so no masks.
class ScanMovement {
 public:
  /// @param noise  one sigma of the ranges [m]
  ScanMovement(const MovementConfig& config, double noise)
      : config_(config), noise_(noise), views_(config) {}

  /// Makes static points of `cloud` dynamic that stand in free space, as far as they belong to
  /// things that are no lines, seen from `T_world_sensor`, the expected pose. A thing that adjoins
  /// a cluster becomes a part of it, any other one a cluster of unknown class.
  /// @returns whether there are any
  bool relabel(LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor) const;

  /// Adds a view with its estimated pose; views that follow the last one too soon are left out.
  void remember(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor);

 private:
  MovementConfig config_;
  double noise_;
  ViewMemory<ScanFreeSpace> views_;
};

}  // namespace mms
