#include "mms/pipeline/perception.hpp"

#include <cassert>
#include <utility>

#include "mms/pipeline/stage_timer.hpp"

namespace mms {
namespace {

FusionConfig fusion_config(const SystemConfig& config) {
  FusionConfig fusion = config.fusion;
  fusion.noise = config.noise.depth;
  fusion.lidar_noise = config.noise.range;
  return fusion;
}

FeatureConfig feature_config(const SystemConfig& config) {
  FeatureConfig features = config.features;
  features.noise = config.noise.depth;
  features.lidar_noise = config.noise.range;
  return features;
}

}  // namespace

Perception::Perception(const SystemConfig& config, std::unique_ptr<Segmenter> segmenter)
    : segmenter_(std::move(segmenter)),
      fusion_(fusion_config(config)),
      extractor_(feature_config(config)) {}

TimedSegmentation Perception::segment(const Frame& frame) {
  assert(segmenter_thread_.is_owner());
  StageTimes times{};
  Segmentation segmentation = timed(times, Stage::kSegmentation, [&] {
    return segmenter_->segment(frame);  // III-A, eq. (1)
  });
  return {std::move(segmentation), times[static_cast<std::size_t>(Stage::kSegmentation)]};
}

PerceivedFrame Perception::perceive(const Frame& frame, const TimedSegmentation& masks) {
  assert(fusion_thread_.is_owner());
  PerceivedFrame result;
  result.stage_ms[static_cast<std::size_t>(Stage::kSegmentation)] = masks.ms;
  result.cloud = timed(result.stage_ms, Stage::kFusion, [&] {
    return fusion_.fuse(frame, masks.segmentation);  // III-B
  });
  result.features = timed(result.stage_ms, Stage::kFeatures, [&] {
    return extractor_.extract(result.cloud);  // III-C.1, eq. (2)
  });
  return result;
}

void Perception::release_threads() {
  segmenter_thread_.release();
  fusion_thread_.release();
}

}  // namespace mms
