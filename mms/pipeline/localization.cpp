#include "mms/pipeline/localization.hpp"

#include <cassert>
#include <utility>

#include "mms/localization/features/feature_exclusion.hpp"
#include "mms/localization/motion/motion_compensation.hpp"
#include "mms/pipeline/stage_timer.hpp"

namespace mms {
namespace {

/// The modes without the method's geometry are baselines: they get none of the steps beyond it.
template <class Config>
Config for_mode(Config step, FusionMode mode) {
  if (mode != FusionMode::kMultimodal) step.enabled = false;
  return step;
}

}  // namespace

Localization::Localization(const SystemConfig& config)
    : odometry_(config.odometry, config.noise.depth),
      motion_segmentation_(for_mode(config.motion_segmentation, config.fusion.mode), config.noise),
      hypotheses_(for_mode(config.mask_check, config.fusion.mode),
                  with_noise(config.features, config.noise), config.fusion.sizes),
      keyframes_(config.keyframes),
      global_keyframes_(config.global_map.keyframes),
      closes_loops_(config.global_map.enabled) {}

FrameResult Localization::localize(PerceivedFrame frame) {
  assert(thread_.is_owner());
  FrameResult result;
  result.stage_ms = frame.stage_ms;
  result.cloud = std::move(frame.cloud);
  result.odometry = timed(result.stage_ms, Stage::kOdometry, [&] {
    deskew(result.cloud, odometry_.velocity());
    exclude_moving_points(result.cloud, frame.features);
    OdometryEstimate estimate = odometry_.accept(hypotheses_.align(
        odometry_, result.cloud, std::move(frame.features)));  // III-C.2, III-C.3, eqs. (3)-(5)
    result.keyframe = keyframes_.is_keyframe(estimate);        // III-C.4
    if (result.keyframe) {
      motion_segmentation_.remember(result.cloud, estimate.T_world_sensor);
      hypotheses_.remember(result.cloud, estimate.T_world_sensor);
    }
    return estimate;
  });
  choose_global_keyframe(result);
  result.dynamic_share = dynamic_share(result.cloud);
  result.overruled_share = overruled_share(result.cloud, result.cloud.overruled);
  return result;
}

void Localization::choose_global_keyframe(FrameResult& result) {
  if (!closes_loops_ || !result.cloud.organised()) return;
  lost_since_global_keyframe_ |= result.odometry.status == Status::kLost;
  result.global_keyframe = global_keyframes_.is_keyframe(result.odometry);
  if (result.global_keyframe) {
    result.after_lost = std::exchange(lost_since_global_keyframe_, false);
  }
}

void Localization::exclude_moving_points(LabeledCloud& cloud, FeatureCloud& features) const {
  const auto expected = odometry_.expected(cloud.stamp);
  if (!expected) return;
  const Image<std::uint8_t> moved = motion_segmentation_.relabel(cloud, *expected);
  if (!moved.empty()) exclude(moved, cloud, features);
}

}  // namespace mms
