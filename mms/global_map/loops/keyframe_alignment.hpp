#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/geometry/depth_noise.hpp"
#include "mms/global_map/keyframes/keyframe_record.hpp"
#include "mms/global_map/loops/loop.hpp"
#include "mms/global_map/loops/loop_config.hpp"

namespace mms {

/// Whether places in an image are spread over enough of it.
/// @param pixels  shares of width and height
bool is_spread(const std::vector<Eigen::Vector2f>& pixels);

/// First relative pose of two keyframes, by pairs of similar keypoints.
class KeyframeAligner {
 public:
  KeyframeAligner(const LoopConfig& config, const DepthNoise& noise)
      : config_(config), noise_(noise) {}

  /// @param loop  receives pose, inliers and the outcome where there are too few
  /// @returns whether enough pairs agree, in enough of the view
  bool align(const KeyframeRecord& a, const KeyframeRecord& b, Loop& loop) const;

 private:
  bool align_scans(const KeyframeRecord& a, const KeyframeRecord& b, Loop& loop) const;
  bool align_keypoints(const ImageKeypoints& a, const ImageKeypoints& b, Loop& loop) const;

  LoopConfig config_;
  DepthNoise noise_;
};

}  // namespace mms
