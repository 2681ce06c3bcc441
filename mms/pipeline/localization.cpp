#include "mms/pipeline/localization.hpp"

#include <cassert>
#include <cstdint>
#include <utility>

#include "mms/core/image.hpp"
#include "mms/localization/features/feature_exclusion.hpp"
#include "mms/localization/motion/motion_compensation.hpp"
#include "mms/pipeline/stage_timer.hpp"

namespace mms {
namespace {

/// The modes without the method's geometry are baselines: they get no motion segmentation either.
MotionSegmentationConfig motion_config(const SystemConfig& config) {
  MotionSegmentationConfig motion = config.motion_segmentation;
  if (config.fusion.mode != FusionMode::kMultimodal) motion.enabled = false;
  return motion;
}

}  // namespace

Localization::Localization(const SystemConfig& config)
    : odometry_(config.odometry, config.noise.depth),
      motion_segmentation_(motion_config(config), config.noise),
      keyframes_(config.keyframes) {}

FrameResult Localization::localize(PerceivedFrame frame) {
  assert(thread_.is_owner());
  FrameResult result;
  result.stage_ms = frame.stage_ms;
  result.cloud = std::move(frame.cloud);
  result.odometry = timed(result.stage_ms, Stage::kOdometry, [&] {
    deskew(result.cloud, odometry_.velocity());
    exclude_moving_points(result.cloud, frame.features);
    OdometryEstimate estimate =
        odometry_.estimate(std::move(frame.features));   // III-C.2, III-C.3, eqs. (3)-(5)
    result.keyframe = keyframes_.is_keyframe(estimate);  // III-C.4
    if (result.keyframe) motion_segmentation_.remember(result.cloud, estimate.T_world_sensor);
    return estimate;
  });
  result.dynamic_share = dynamic_share(result.cloud);
  return result;
}

void Localization::exclude_moving_points(LabeledCloud& cloud, FeatureCloud& features) const {
  const auto expected = odometry_.expected(cloud.stamp);
  if (!expected) return;
  const Image<std::uint8_t> moved = motion_segmentation_.relabel(cloud, *expected);
  if (!moved.empty()) exclude(moved, cloud, features);
}

}  // namespace mms
