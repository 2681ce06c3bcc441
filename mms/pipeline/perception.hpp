#pragma once

#include <memory>
#include <optional>

#include "mms/core/frame.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/segmentation.hpp"
#include "mms/core/thread_confinement.hpp"
#include "mms/fusion/semantic_fusion.hpp"
#include "mms/localization/features/feature_extractor.hpp"
#include "mms/pipeline/frame_result.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

/// Output of III-A.
struct TimedSegmentation {
  Segmentation segmentation;
  double ms = 0.0;
};

/// Output of the steps before the pose: III-A, III-B, III-C.1.
struct PerceivedFrame {
  LabeledCloud cloud;
  FeatureCloud features;
  MotionSamples motion;  ///< of the frame
  MotionCalibration motion_calibration;
  std::optional<Transform<Global, Sensor>> expected_place;  ///< of the frame
  StageTimes stage_ms{};
};

/// The stage before the pose: masks, static and dynamic points, features. Owns the segmenter, the
/// masks and objects that the fusion remembers, and nothing of pose or maps.
class Perception {
 public:
  Perception(const SystemConfig& config, std::unique_ptr<Segmenter> segmenter);

  /// III-A. One thread at a time; it may differ from that of `perceive`.
  TimedSegmentation segment(const Frame& frame);

  /// III-B and III-C.1. One thread at a time. Frames come in the order of their stamps.
  /// @throws DataError when the frame's images and calibration disagree in size
  PerceivedFrame perceive(const Frame& frame, const TimedSegmentation& masks);

  void release_threads();  ///< lets other threads call

 private:
  std::unique_ptr<Segmenter> segmenter_;
  ThreadConfinement segmenter_thread_;
  SemanticFusion fusion_;
  FeatureExtractor extractor_;
  ThreadConfinement fusion_thread_;
};

}  // namespace mms
