#pragma once

#include <array>
#include <cstdint>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/fusion/config/fusion_config.hpp"
#include "mms/localization/features/feature_extractor.hpp"
#include "mms/localization/odometry.hpp"
#include "mms/mapping/motion_segmentation/mask_check.hpp"

namespace mms {

/// Estimates the pose of a frame under the hypotheses that its masks are right, or partly or all
/// wrong, and decides between them by the surfaces of recent views (beyond the paper; see
/// docs/fusion.md).
class PoseHypotheses {
 public:
  using Sizes = std::array<ObjectSize, kObjectClassCount>;

  PoseHypotheses(const MaskCheckConfig& mask_check, const FeatureConfig& features,
                 const Sizes& sizes);

  /// @param cloud     its `overruled` points are set
  /// @param features  of its static points
  Odometry::Alignment align(const Odometry& odometry, LabeledCloud& cloud,
                            FeatureCloud features) const;

  /// Adds a view to compare later frames with.
  void remember(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor) {
    mask_check_.remember(cloud, T_world_sensor);
  }

 private:
  Odometry::Alignment align_judged(const Odometry& odometry, LabeledCloud& cloud,
                                   FeatureCloud features, double masked) const;
  Odometry::Alignment reconsider(const Odometry& odometry, LabeledCloud& cloud,
                                 Odometry::Alignment first, double overruled,
                                 bool may_be_poor) const;
  Odometry::Alignment align_first(const Odometry& odometry, LabeledCloud& cloud,
                                  double masked) const;
  Odometry::Alignment align_overruled(const Odometry& odometry, LabeledCloud& cloud,
                                      Image<std::uint8_t> overruled) const;

  MaskCheck mask_check_;
  FeatureExtractor extractor_;  ///< of frames whose masks were overruled
  Sizes sizes_;
};

}  // namespace mms
