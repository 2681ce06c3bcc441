#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/geometry/depth_noise.hpp"
#include "mms/mapping/free_space/free_space.hpp"
#include "mms/mapping/motion_segmentation/free_space_history.hpp"
#include "mms/mapping/motion_segmentation/motion_segmentation_config.hpp"

namespace mms {

/// Finds what moves without a name (beyond the paper, which knows only what the network was
/// taught): points that stand where a view some moments ago looked through. A person whom the
/// network missed is found like a cart that it never learned. Of organised clouds;
/// `ScanMotionSegmentation` is that of LiDAR scans.
class MotionSegmentation {
 public:
  MotionSegmentation(const MotionSegmentationConfig& config, const DepthNoise& noise)
      : config_(config), noise_(noise), views_(config) {}

  /// Makes static points of `cloud` dynamic that stand in free space, as far as they belong to
  /// components wider than the boundaries that an error of `T_world_sensor`, the expected pose,
  /// gives. A component that adjoins a cluster becomes a part of it, any other one a cluster of
  /// unknown class.
  /// @returns non-zero at their pixels; empty where there are none
  Image<std::uint8_t> relabel(LabeledCloud& cloud,
                              const Transform<World, Sensor>& T_world_sensor) const;

  /// Adds a view with its estimated pose; views that follow the last one too soon are left out.
  void remember(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor);

 private:
  MotionSegmentationConfig config_;
  DepthNoise noise_;
  FreeSpaceHistory<FreeSpace> views_;
};

}  // namespace mms
