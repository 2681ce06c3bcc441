#pragma once

#include <future>
#include <memory>
#include <optional>
#include <utility>

#include "mms/core/frame.hpp"
#include "mms/pipeline/frame_result.hpp"
#include "mms/pipeline/localization.hpp"
#include "mms/pipeline/loop_closing.hpp"
#include "mms/pipeline/mapping.hpp"
#include "mms/pipeline/perception.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

/// The whole method, one frame at a time, as four stages that each own their state. Synchronous:
/// has no thread, file or clock except the stopwatch of its steps. Parallel steps run in the
/// caller's tbb::task_arena; the result does not depend on its number of threads.
class SlamSystem {
 public:
  /// @param segmenter  gives the masks (III-A); not null
  SlamSystem(const SystemConfig& config, std::unique_ptr<Segmenter> segmenter)
      : perception_(config, std::move(segmenter)),
        localization_(config),
        loop_closing_(config),
        mapping_(config) {}

  /// Takes an earlier map before the first frame; the place of the sensor in it is recognized.
  void restore(GlobalMapContent map, MapUse use) {
    loop_closing_.restore(std::move(map), use);
    localization_.search_place();
  }

  /// Localizes a frame and integrates it into the maps. Frames come in the order of their stamps.
  /// @throws DataError when the frame's images, scan and calibration disagree in size, or it has no
  /// calibration
  FrameResult process(const Frame& frame) {
    FrameResult result = localize(perceive(frame, segment(frame)));
    if (result.wants_relocalization) {
      const auto place = relocalize(global_keyframe(frame, result));
      if (place) result = relocate(std::move(result), *place);
    }
    if (result.global_keyframe) {
      std::promise<MapCorrection> correction;
      corrections().add(frame.stamp, correction.get_future());
      correction.set_value(close_loops(global_keyframe(frame, result)));
    }
    return map(std::move(result));
  }

  // The steps of `process`, for a pipeline in which successive frames overlap. `segment`,
  // `perceive`, `localize` with `relocate`, `close_loops` with `relocalize`, and `map` may each
  // have their own thread; debug builds assert that they keep it until `release_threads`.
  TimedSegmentation segment(const Frame& frame) { return perception_.segment(frame); }
  PerceivedFrame perceive(const Frame& frame, const TimedSegmentation& masks) {
    return perception_.perceive(frame, masks);
  }
  FrameResult localize(PerceivedFrame frame) { return localization_.localize(std::move(frame)); }
  FrameResult relocate(FrameResult lost, const Relocalization& place) {
    return localization_.relocate(std::move(lost), place);
  }
  MapCorrection close_loops(const GlobalKeyframe& keyframe) {
    return loop_closing_.close_loops(keyframe);
  }
  /// Takes the results of `close_loops`, in the thread of `localize`.
  CorrectionFeed& corrections() { return localization_.corrections(); }
  std::optional<Relocalization> relocalize(const GlobalKeyframe& frame) {
    return loop_closing_.relocalize(frame);
  }
  FrameResult map(FrameResult localized) { return mapping_.map(std::move(localized)); }

  /// Completes the maps after the last frame; see `Mapping::finalize`.
  std::optional<MapChanges> finalize() {
    loop_closing_.finish();
    return mapping_.finalize();
  }

  /// Lets other threads call the steps; to be called while none of them runs.
  void release_threads() {
    perception_.release_threads();
    localization_.release_thread();
    loop_closing_.release_thread();
    mapping_.release_thread();
  }

  /// What `close_loops` takes of a localized frame.
  static GlobalKeyframe global_keyframe(const Frame& frame, const FrameResult& localized) {
    return {frame.color,
            localized.cloud,
            localized.odometry.T_world_sensor,
            localized.after_lost,
            localized.has_pose_in_doubt,
            localized.session,
            localized.expected_place};
  }

  const GlobalMap& global_map() const { return loop_closing_.global_map(); }

  // To be read in the thread of `map`.
  const Mapping& mapping() const { return mapping_; }
  const StaticMap& static_map() const { return mapping_.static_map(); }
  const OccupancyMap& occupancy_map() const { return mapping_.occupancy_map(); }
  const DynamicMap& dynamic_map() const { return mapping_.dynamic_map(); }

 private:
  Perception perception_;
  Localization localization_;
  LoopClosing loop_closing_;
  Mapping mapping_;
};

}  // namespace mms
