#pragma once

#include "mms/core/frame.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/segmentation.hpp"
#include "mms/fusion/clouds/depth_cloud.hpp"
#include "mms/fusion/config/fusion_config.hpp"
#include "mms/fusion/masks/mask_memory.hpp"

namespace mms {

/// Divides a frame's points into static and dynamic ones (III-B) by merging the segmented masks
/// with Euclidean clusters of the points. Frames must be given in order: dynamic objects are
/// remembered for `FusionConfig::memory`. The same frames give the same bits.
class SemanticFusion {
 public:
  explicit SemanticFusion(const FusionConfig& config);

  /// Labels the depth image's points, or the LiDAR scan's where there is no depth image.
  /// @throws DataError when masks, image, depth or calibration disagree in size
  LabeledCloud fuse(const Frame& frame, const Segmentation& segmentation);

 private:
  LabeledCloud fuse_depth(const Frame& frame, const Segmentation& segmentation);
  LabeledCloud fuse_scan(const Frame& frame, const Segmentation& segmentation);

  FusionConfig config_;
  FusionConfig present_;  ///< with the stride of the last images
  DepthCloudBuilder depth_cloud_;
  MaskMemory memory_;
};

}  // namespace mms
