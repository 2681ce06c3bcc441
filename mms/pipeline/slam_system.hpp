#pragma once

#include <memory>
#include <optional>

#include "mms/core/frame.hpp"
#include "mms/fusion/semantic_fusion.hpp"
#include "mms/localization/features/feature_extractor.hpp"
#include "mms/localization/odometry.hpp"
#include "mms/mapping/motion_segmentation/motion_segmentation.hpp"
#include "mms/mapping/motion_segmentation/scan_motion_segmentation.hpp"
#include "mms/mapping/occupancy/occupancy_map.hpp"
#include "mms/mapping/static_map/keyframe_selector.hpp"
#include "mms/mapping/static_map/static_map.hpp"
#include "mms/mapping/tracking/dynamic_map.hpp"
#include "mms/pipeline/config.hpp"
#include "mms/pipeline/frame_result.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

/// Output of III-A.
struct TimedSegmentation {
  Segmentation segmentation;
  double ms = 0.0;
};

/// Output of a frame's steps before its pose is sought (III-A, III-B, III-C.1).
struct Perception {
  LabeledCloud labeled;
  FeatureCloud features;
  StageTimes stage_ms{};
};

/// The whole method, one frame at a time. Synchronous: owns no thread, file or clock beside the
/// stop watch of its stages. Parallel steps run in the caller's tbb::task_arena; the result does
/// not depend on how many threads that has.
class SlamSystem {
 public:
  /// @throws ConfigError when a setting makes no sense with another.
  SlamSystem(const SystemConfig& config, std::unique_ptr<Segmenter> segmenter);

  /// Localises a frame and integrates it into the maps. Frames come in the order of their stamps.
  /// @throws DataError when the frame's images and calibration disagree in size.
  FrameResult process(const Frame& frame);

  /// The parts of `process`, for a pipeline that overlaps them between frames.
  TimedSegmentation segment(const Frame& frame);
  Perception perceive(const Frame& frame, const TimedSegmentation& masks);
  FrameResult localize(Perception perception);  ///< all of the result but the objects
  FrameResult map(FrameResult localized);

  /// Ends the static map's last look, once all frames are in.
  /// @return  what the frames since the last keyframe did to it; nothing where there are none
  std::optional<MapChanges> end();

  const StaticMap& static_map() const { return static_map_; }
  const OccupancyMap& occupancy_map() const { return occupancy_map_; }
  const DynamicMap& dynamic_map() const { return dynamic_map_; }

 private:
  void mask_moving_points(LabeledCloud& cloud, FeatureCloud& features) const;

  std::unique_ptr<Segmenter> segmenter_;
  SemanticFusion fusion_;
  FeatureExtractor extractor_;
  Odometry odometry_;
  MotionSegmentation motion_segmentation_;
  ScanMotionSegmentation scan_motion_segmentation_;
  KeyframeSelector keyframes_;
  StaticMap static_map_;
  OccupancyMap occupancy_map_;
  DynamicMap dynamic_map_;
};

}  // namespace mms
