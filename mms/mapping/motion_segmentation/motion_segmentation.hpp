#pragma once

#include <cstdint>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/geometry/sensor_noise.hpp"
#include "mms/mapping/free_space/free_space.hpp"
#include "mms/mapping/free_space/free_space_history.hpp"
#include "mms/mapping/free_space/scan_free_space.hpp"
#include "mms/mapping/motion_segmentation/motion_segmentation_config.hpp"

namespace mms {

/// Detects moving objects without masks (beyond the paper): points that are where a recent view
/// observed free space. It finds people that the network missed and objects of unknown class, in
/// depth images and in LiDAR scans.
class MotionSegmentation {
 public:
  MotionSegmentation(const MotionSegmentationConfig& config, const SensorNoise& noise)
      : config_(config),
        noise_(noise),
        images_(config.memory, config.interval),
        scans_(config.memory, config.interval) {}

  /// Makes static points of `cloud` in free space dynamic where they form components: wider than
  /// what an error of the pose causes at boundaries, and no lines (scans). A component that adjoins
  /// a cluster becomes a part of it, any other one a new cluster of unknown class.
  /// @param T_world_sensor  expected pose
  /// @returns non-zero at these points, width x height of the cloud; empty without any
  Image<std::uint8_t> relabel(LabeledCloud& cloud,
                              const Transform<World, Sensor>& T_world_sensor) const;

  /// Adds a view with its estimated pose; a view too soon after the last one is ignored.
  void remember(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor);

 private:
  MotionSegmentationConfig config_;
  SensorNoise noise_;
  FreeSpaceHistory<FreeSpace> images_;
  FreeSpaceHistory<ScanFreeSpace> scans_;
};

}  // namespace mms
