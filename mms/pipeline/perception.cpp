#include "mms/pipeline/perception.hpp"

#include <cassert>
#include <utility>

#include "mms/pipeline/stage_timer.hpp"

namespace mms {

Perception::Perception(const SystemConfig& config, std::unique_ptr<Segmenter> segmenter)
    : segmenter_(std::move(segmenter)),
      fusion_(with_noise(config.fusion, config.noise)),
      extractor_(with_noise(config.features, config.noise)) {}

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
  result.motion = frame.motion;
  result.motion_calibration = frame.calibration->motion;
  result.expected_place = frame.expected_place;
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
