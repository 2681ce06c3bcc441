#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/evaluation/metrics.hpp"
#include "mms/global_map/global_map.hpp"
#include "mms/mapping/tracking/object_smoother.hpp"
#include "mms/pipeline/async_pipeline.hpp"
#include "mms/pipeline/session_places.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/report/report.hpp"
#include "mms/run/record/logged_frame.hpp"
#include "mms/simulation/truth/truth_cloud.hpp"

namespace mms {

/// Collects the data for a run's files. Until `finish`, the frames are on disk.
class RunLog {
 public:
  /// @param compare_masks  whether the frames' masks are ground truth and not the run's input
  /// @param objects        settings of the dynamic map
  /// @param folder         for temporary files; empty: all stays in memory
  RunLog(Trajectory truth, bool compare_masks, const DynamicMapConfig& objects,
         const std::filesystem::path& folder = {});

  void add(const Processed& processed);

  /// Computes the summary after the last frame.
  /// @param skipped  number of unreadable frames
  /// @param dropped  number of frames of a live sensor that were not taken in time
  void finish(std::size_t skipped, std::size_t dropped, const AsyncPipeline& pipeline,
              const SlamSystem& system);

  /// Compares the tracked objects with the ground truth, in the frame of the ground-truth poses.
  void compare_objects(const ObjectHistory& truth);

  /// Compares the static map with the ground truth, transformed to the map's frame by aligning the
  /// corrected poses of all frames with ground truth that are not lost. Does nothing without such
  /// frames.
  /// @param truth  in the world frame of the ground-truth poses
  /// @throws DataError if the ground truth has no valid points.
  void compare_map(const TruthCloud& truth, const std::vector<Eigen::Vector3f>& map);

  std::size_t size() const { return frame_log_.size(); }  ///< frames so far
  /// With the default values before `add`.
  const LoggedFrame& first() const { return first_; }
  const LoggedFrame& last() const { return last_; }
  /// All frames; empty before `finish`.
  const std::vector<LoggedFrame>& frames() const { return frames_; }
  /// Smoothed objects (ObjectSmoother) in the global frame; empty before `finish`.
  const ObjectHistory& objects() const { return objects_; }
  /// The tracked objects of the last frame; call after `add`.
  const std::vector<ObjectBox>& objects_now() const { return objects_now_.objects; }
  const std::vector<ReportPicture>& pictures() const { return pictures_; }
  const RunMetrics& metrics() const { return metrics_; }
  const Trajectory& truth() const { return truth_; }
  bool has_image() const { return has_image_; }

  // Of all frames; empty before `finish`.
  Trajectory trajectory() const;
  Trajectory keyframes() const;
  /// Poses in the frame of the map, of the frames whose place in it is known; those of `trajectory`
  /// without loops and losses.
  Trajectory corrected_trajectory() const;
  /// Poses of a session in its own frame, corrected by the loops in it.
  Trajectory session_trajectory(std::uint32_t session) const;
  /// Pose of a frame in the frame of the map, if it is known.
  std::optional<Transform<World, Sensor>> corrected_pose(const LoggedFrame& frame) const;
  /// Possible loops that were checked; empty before `finish`.
  const std::vector<Loop>& loops() const { return loops_; }
  /// Stamp of a keyframe of the global map.
  Timestamp stamp_of_keyframe(std::size_t keyframe) const { return loop_stamps_[keyframe]; }
  /// Whether a keyframe of the global map is of this run, not of an earlier map.
  bool is_own_keyframe(std::size_t keyframe) const { return own_keyframes_[keyframe]; }
  /// Places of the run's sessions, by their number; of one without loops before `finish`.
  const std::vector<SessionPlace>& places() const { return places_; }

 private:
  void keep_picture(const Processed& processed);
  void sum_up_times();
  void sum_up_latency(std::size_t dropped, const AsyncPipeline& pipeline);
  void sum_up_accuracy();
  void sum_up_loops(const GlobalMap& map);
  SessionMetrics session_metrics() const;
  /// Transform from the frame of the ground truth to that of the poses, without lost frames.
  std::optional<Eigen::Isometry3d> aligned_to(const Trajectory& poses) const;
  void move_objects();

  Trajectory truth_;
  DiskLog<LoggedFrame> frame_log_;
  LoggedFrame first_;
  LoggedFrame last_;
  std::vector<LoggedFrame> frames_;
  ObjectSmoother smoother_;
  DiskLog<ObjectFrame> smoothed_log_;
  DiskLog<ObjectFrame> live_log_;  ///< live output of the dynamic map
  ObjectFrame objects_now_;
  ObjectHistory objects_;
  std::vector<ReportPicture> pictures_;
  std::size_t picture_stride_ = 1;
  std::vector<Loop> loops_;
  std::vector<Timestamp> loop_stamps_;  ///< by keyframe of the global map
  std::vector<bool> own_keyframes_;     ///< likewise
  std::vector<SessionPlace> places_{1};
  bool has_image_ = false;
  bool compare_masks_ = false;
  RunMetrics metrics_;
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_time_ = start_;
};

}  // namespace mms
