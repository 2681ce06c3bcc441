#pragma once

#include <cstdint>
#include <optional>

#include "mms/core/thread_confinement.hpp"
#include "mms/core/time.hpp"
#include "mms/global_map/global_map.hpp"
#include "mms/localization/odometry.hpp"
#include "mms/localization/robot_body/robot_body.hpp"
#include "mms/mapping/motion_segmentation/motion_segmentation.hpp"
#include "mms/mapping/static_map/keyframe_selector.hpp"
#include "mms/pipeline/correction_feed.hpp"
#include "mms/pipeline/frame_result.hpp"
#include "mms/pipeline/masked_start.hpp"
#include "mms/pipeline/perception.hpp"
#include "mms/pipeline/pose_hypotheses.hpp"
#include "mms/pipeline/system_config.hpp"

namespace mms {

/// The stage that estimates the pose. Owns the local maps, the motion model, the free space and
/// surfaces of recent views and the choice of keyframes.
class Localization {
 public:
  explicit Localization(const SystemConfig& config);

  /// III-C.2, III-C.3 and the choice of keyframes of III-C.4; before that the points of moving
  /// objects without a mask are labeled dynamic. Where the sensor is lost for seconds, though it
  /// sees enough, a new session begins. One thread at a time, frames in order.
  /// @returns the result without objects
  FrameResult localize(PerceivedFrame frame);

  /// Continues at the recognized place of a frame, if the odometry does not agree with it.
  /// @param lost  result of `localize` for that frame
  FrameResult relocate(FrameResult lost, const Relocalization& place);

  /// Takes more keyframes for the global map in the first seconds, since an earlier map was given
  /// in which the place is to be recognized.
  void search_place() {
    searches_place_ = true;
    corrections_ = CorrectionFeed({});
  }

  /// Corrections by loop closure for the frames that follow.
  CorrectionFeed& corrections() { return corrections_; }

  void release_thread() { thread_.release(); }  ///< lets another thread call

 private:
  /// What compares frames with those before in the world of a session.
  struct Session {
    explicit Session(const SystemConfig& config);

    MotionSegmentation motion_segmentation;
    PoseHypotheses hypotheses;
    KeyframeSelector keyframes;
    KeyframeSelector global_keyframes;
    KeyframeSelector scan_keyframes;  // of the global map, too
  };

  /// Where a user says that the sensor is.
  struct ExpectedPlace {
    Timestamp stamp;  // of the frame that it was given with
    Transform<Global, World> T_global_world;
  };

  OdometryEstimate estimate_pose(const PerceivedFrame& frame, LabeledCloud& cloud,
                                 FeatureCloud features);
  void search_robot_body(const std::optional<RobotBody::SeenFrame>& seen, FrameResult& result,
                         OdometryEstimate& estimate);
  void search_again(Timestamp stamp);
  std::optional<Transform<Global, Sensor>> expected_place(const FrameResult& result);
  bool is_lost_for_long(Duration interval, const FeatureCloud& features);
  void begin_session();
  void exclude_moving_points(LabeledCloud& cloud, FeatureCloud& features) const;
  bool wants_relocalization(const FrameResult& result);
  void choose_keyframes(FrameResult& result);
  bool is_search_keyframe(const FrameResult& result);

  SystemConfig config_;
  Odometry odometry_;
  std::optional<MaskedStart> masked_start_;
  RobotBody robot_body_;
  Session session_;
  std::uint32_t session_number_ = 0;
  CorrectionFeed corrections_{MapCorrection{Transform<Global, World>()}};
  bool closes_loops_;
  bool lost_since_global_keyframe_ = false;
  bool searches_place_ = false;
  std::optional<Timestamp> search_begin_;
  Timestamp last_search_;
  std::optional<ExpectedPlace> expected_;
  bool has_global_keyframe_ = false;
  int lost_frames_ = 0;       // in a row
  bool is_in_doubt_ = false;  // since a loss or a gap: the place is not recognized yet
  bool is_lost_ = false;      // the last frame
  Timestamp last_stamp_;
  Duration last_interval_ = Duration::zero();  // between the last two frames
  Duration lost_for_ = Duration::zero();       // of lost frames with enough features
  ThreadConfinement thread_;
};

}  // namespace mms
