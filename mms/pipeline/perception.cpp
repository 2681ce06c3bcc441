#include "mms/pipeline/perception.hpp"

#include <cassert>
#include <string>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/pipeline/stage_timer.hpp"

namespace mms {
namespace {

void check_length(const Frame& frame, const char* what, std::size_t length) {
  const std::size_t points = frame.scan.points.size();
  if (length == 0 || length == points) return;
  throw DataError("frame " + frame.name,
                  std::string(what) + " has " + std::to_string(length) +
                      " numbers, but the scan has " + std::to_string(points) + " points",
                  "give one for each point, or none");
}

void check(const Frame& frame) {
  if (!frame.calibration) {
    throw DataError("frame " + frame.name, "has no calibration",
                    "a LiDAR alone takes an empty mms::Calibration");
  }
  check_length(frame, "time_offset", frame.scan.time_offset.size());
  check_length(frame, "intensity", frame.scan.intensity.size());
}

}  // namespace

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
  check(frame);
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
