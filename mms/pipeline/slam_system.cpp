#include "mms/pipeline/slam_system.hpp"

#include <chrono>
#include <utility>

#include "mms/localization/features/feature_exclusion.hpp"
#include "mms/localization/motion/motion_compensation.hpp"
#include "mms/mapping/tracking/unseen_objects.hpp"

namespace mms {
namespace {

/// Runs one step and notes how long it took.
template <class Step>
auto timed(StageTimes& times, Stage stage, const Step& step) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  auto result = step();
  const std::chrono::duration<double, std::milli> elapsed = Clock::now() - start;
  times[static_cast<std::size_t>(stage)] = elapsed.count();
  return result;
}

/// Gives every module the one noise model of the sensor.
SystemConfig with_shared_noise(SystemConfig config) {
  config.fusion.noise = config.depth_noise;
  config.fusion.lidar_noise = config.lidar_noise;
  config.features.lidar_noise = config.lidar_noise;
  config.features.noise = config.depth_noise;
  config.static_map.surface.noise = config.depth_noise;
  // Without masks, or with them alone, is how the method is compared with what was before it.
  if (config.fusion.mode != FusionMode::kMultimodal) config.motion_segmentation.enabled = false;
  return config;
}

}  // namespace

SlamSystem::SlamSystem(const SystemConfig& given, std::unique_ptr<Segmenter> segmenter)
    : segmenter_(std::move(segmenter)),
      fusion_(with_shared_noise(given).fusion),
      extractor_(with_shared_noise(given).features),
      odometry_(given.odometry, given.depth_noise),
      motion_segmentation_(with_shared_noise(given).motion_segmentation, given.depth_noise),
      scan_motion_segmentation_(with_shared_noise(given).motion_segmentation, given.lidar_noise),
      keyframes_(given.keyframes),
      static_map_(with_shared_noise(given).static_map),
      occupancy_map_(given.occupancy, with_shared_noise(given).static_map.surface),
      dynamic_map_(given.dynamic_map) {}

FrameResult SlamSystem::process(const Frame& frame) {
  return map(localize(perceive(frame, segment(frame))));
}

TimedSegmentation SlamSystem::segment(const Frame& frame) {
  StageTimes times{};
  Segmentation segmentation = timed(times, Stage::kSegmentation, [&] {
    return segmenter_->segment(frame);  // III-A, eq. (1)
  });
  return {std::move(segmentation), times[static_cast<std::size_t>(Stage::kSegmentation)]};
}

Perception SlamSystem::perceive(const Frame& frame, const TimedSegmentation& masks) {
  Perception p;
  p.stage_ms[static_cast<std::size_t>(Stage::kSegmentation)] = masks.ms;
  p.labeled = timed(p.stage_ms, Stage::kFusion, [&] {
    return fusion_.fuse(frame, masks.segmentation);  // III-B
  });
  p.features = timed(p.stage_ms, Stage::kFeatures, [&] {
    return extractor_.extract(p.labeled);  // III-C.1, eq. (2)
  });
  return p;
}

void SlamSystem::mask_moving_points(LabeledCloud& cloud, FeatureCloud& features) const {
  const auto expected = odometry_.expected(cloud.stamp);
  if (!expected) return;
  const Image<std::uint8_t> moved = motion_segmentation_.relabel(cloud, *expected);
  if (!moved.empty()) exclude(moved, cloud.camera, features);
  if (scan_motion_segmentation_.relabel(cloud, *expected)) exclude_dynamic(cloud.labels, features);
}

FrameResult SlamSystem::localize(Perception perception) {
  FrameResult result;
  result.stage_ms = perception.stage_ms;
  result.cloud = std::move(perception.labeled);
  result.odometry = timed(result.stage_ms, Stage::kOdometry, [&] {
    deskew(result.cloud, odometry_.velocity());
    mask_moving_points(result.cloud, perception.features);
    OdometryEstimate estimate =
        odometry_.estimate(std::move(perception.features));  // III-C.2, III-C.3, eqs. (3)-(5)
    result.keyframe = keyframes_.is_keyframe(estimate);      // III-C.4
    if (result.keyframe) {
      motion_segmentation_.remember(result.cloud, estimate.T_world_sensor);
      scan_motion_segmentation_.remember(result.cloud, estimate.T_world_sensor);
    }
    return estimate;
  });
  result.dynamic_share = dynamic_share(result.cloud);
  return result;
}

FrameResult SlamSystem::map(FrameResult result) {
  result.objects = timed(result.stage_ms, Stage::kMapping, [&] {
    const Transform<World, Sensor>& T_world_sensor = result.odometry.T_world_sensor;
    dynamic_map_.update(result.cloud, result.odometry);  // III-D
    std::vector<TrackedObject> objects = dynamic_map_.objects();
    mask_unseen_objects(objects, T_world_sensor, result.cloud);
    if (result.keyframe) {
      static_map_.integrate(result.cloud, T_world_sensor);
      occupancy_map_.integrate(result.cloud, T_world_sensor);
    } else if (result.odometry.status != Status::kLost) {
      static_map_.add(result.cloud, T_world_sensor);
    }
    return objects;
  });
  return result;
}

std::optional<MapChanges> SlamSystem::end() {
  if (!static_map_.finalize()) return std::nullopt;
  return static_map_.changes();
}

}  // namespace mms
