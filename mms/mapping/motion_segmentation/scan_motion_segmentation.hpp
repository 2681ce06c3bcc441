#pragma once

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/free_space/scan_free_space.hpp"
#include "mms/mapping/motion_segmentation/free_space_history.hpp"
#include "mms/mapping/motion_segmentation/motion_segmentation_config.hpp"

namespace mms {

/// What `MotionSegmentation` is for organised clouds, for LiDAR scans: finds what moves without a
/// name, in all directions, where most have no camera and so no masks.
class ScanMotionSegmentation {
 public:
  /// @param noise  one sigma of the ranges [m]
  ScanMotionSegmentation(const MotionSegmentationConfig& config, double noise)
      : config_(config), noise_(noise), views_(config) {}

  /// Makes static points of `cloud` dynamic that stand in free space, as far as they belong to
  /// components that are no lines, seen from `T_world_sensor`, the expected pose. A component that
  /// adjoins a cluster becomes a part of it, any other one a cluster of unknown class.
  /// @returns whether there are any
  bool relabel(LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor) const;

  /// Adds a view with its estimated pose; views that follow the last one too soon are left out.
  void remember(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor);

 private:
  MotionSegmentationConfig config_;
  double noise_;
  FreeSpaceHistory<ScanFreeSpace> views_;
};

}  // namespace mms
