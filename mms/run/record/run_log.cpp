#include "mms/run/record/run_log.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "mms/evaluation/scores/statistics.hpp"
#include "mms/evaluation/trajectory/truth_frame.hpp"
#include "mms/run/record/overlay.hpp"
#include "mms/run/record/peak_memory.hpp"

namespace mms {
namespace {

constexpr std::size_t kMaxPictures = 8;
constexpr std::size_t kMinPosesForError = 3;
constexpr double kStandsStill = 0.01;  ///< largest movement of a static sensor [m]

template <class Value>
std::vector<double> column(const std::vector<LoggedFrame>& frames, const Value& value) {
  std::vector<double> values;
  values.reserve(frames.size());
  for (const LoggedFrame& frame : frames) values.push_back(value(frame));
  return values;
}

bool is_in_map(const FrameResult& result) {
  return result.odometry.status != Status::kLost && result.correction.T_global_world.has_value();
}

/// Nothing where too few poses match for it: a metric must not cost the results of a run.
std::optional<TrajectoryError> error_of(const Trajectory& truth, const Trajectory& estimate) {
  const auto matched = match_by_stamp(truth, estimate, TrajectoryErrorOptions{}.max_difference);
  if (matched.size() < kMinPosesForError) return std::nullopt;
  return evaluate_trajectory(truth, estimate);
}

}  // namespace

RunLog::RunLog(Trajectory truth, bool compare_masks, const DynamicMapConfig& objects,
               const std::filesystem::path& folder)
    : truth_(std::move(truth)),
      frame_log_(folder),
      smoother_(objects),
      smoothed_log_(folder),
      live_log_(folder),
      compare_masks_(compare_masks) {}

void RunLog::add(const Processed& processed) {
  const FrameResult& result = processed.result;
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double, std::milli> interval = now - last_time_;
  last_time_ = now;
  last_ = {processed.frame.stamp,  processed.frame.index,
           result.session,         result.odometry.T_world_sensor,
           result.odometry.status, result.keyframe,
           result.relocalized,     result.is_searching(),
           is_in_map(result),      result.dynamic_share,
           result.overruled_share, result.cloud.implausible_masks,
           processed.read_ms,      interval.count(),
           result.stage_ms,        processed.latency_ms};
  if (size() == 0) first_ = last_;
  frame_log_.add(last_);
  places_.resize(result.session + std::size_t{1});
  smoother_.add(processed.frame.stamp, result.objects);
  for (const ObjectFrame& settled : smoother_.take_settled()) smoothed_log_.add(settled);
  objects_now_ = {processed.frame.stamp, {}};
  for (const TrackedObject& object : result.objects) objects_now_.objects.push_back(object.box);
  live_log_.add(objects_now_);
  has_image_ = has_image_ || result.cloud.organised();
  keep_picture(processed);
  if (!compare_masks_ || processed.frame.mask.empty()) return;
  if (!metrics_.masks) metrics_.masks.emplace();
  metrics_.masks->add(processed.frame.mask, result.cloud);
}

void RunLog::keep_picture(const Processed& processed) {
  // Evenly distributed over a run of unknown length: if there are too many, every second one is
  // removed.
  if ((size() - 1) % picture_stride_ != 0 || !processed.result.cloud.organised()) return;
  pictures_.push_back({fmt::format("{} ({:.0f} % dynamic)", processed.frame.name,
                                   100.0 * processed.result.dynamic_share),
                       draw_overlay(processed.result.cloud)});
  if (pictures_.size() <= kMaxPictures) return;
  std::vector<ReportPicture> kept;
  for (std::size_t i = 0; i < pictures_.size(); i += 2) kept.push_back(std::move(pictures_[i]));
  pictures_ = std::move(kept);
  picture_stride_ *= 2;
}

void RunLog::finish(std::size_t skipped, std::size_t dropped, const AsyncPipeline& pipeline,
                    const SlamSystem& system) {
  dropped += pipeline.dropped();
  frames_ = frame_log_.read();
  sum_up_times();
  sum_up_latency(dropped, pipeline);
  sum_up_accuracy();
  sum_up_loops(system.global_map());
  metrics_.frames_skipped = static_cast<std::int64_t>(skipped + dropped);
  metrics_.peak_memory_mb = peak_memory_mb();
  for (const LoggedFrame& frame : frames_) {
    ++metrics_.status[static_cast<std::size_t>(frame.status)];
    metrics_.implausible_masks += frame.implausible_masks;
    metrics_.overruled_frames += frame.overruled_share > 0.0;
    metrics_.overruled_share += frame.overruled_share / static_cast<double>(frames_.size());
    metrics_.dynamic_share += frame.dynamic_share / static_cast<double>(frames_.size());
  }
  metrics_.tracks = system.dynamic_map().confirmed();
  for (const ObjectFrame& settled : smoother_.history()) smoothed_log_.add(settled);
  objects_ = smoothed_log_.read();
  if (are_corrected(places_)) move_objects();
}

/// To the frame of the map. Objects that were seen where that is not known are left out.
void RunLog::move_objects() {
  ObjectHistory moved;
  auto frame = frames_.begin();
  for (const ObjectFrame& seen : objects_) {
    frame = std::find_if(frame, frames_.end(),
                         [&](const LoggedFrame& logged) { return logged.stamp == seen.stamp; });
    if (frame == frames_.end()) break;
    const SessionPlace& place = places_[frame->session];
    if (!place.is_known) continue;
    moved.push_back(transformed({seen}, place.correction.at(seen.stamp).isometry()).front());
  }
  objects_ = std::move(moved);
}

void RunLog::sum_up_times() {
  const std::chrono::duration<double> elapsed = last_time_ - start_;
  metrics_.frames = static_cast<std::int64_t>(frames_.size());
  metrics_.rate_hz = static_cast<double>(frames_.size()) / elapsed.count();
  metrics_.ms_per_frame =
      time_statistics(column(frames_, [](const LoggedFrame& f) { return f.interval_ms; }));
  metrics_.stages.emplace_back(
      "read", time_statistics(column(frames_, [](const LoggedFrame& f) { return f.read_ms; })));
  for (std::size_t i = 0; i < kStageCount; ++i) {
    metrics_.stages.emplace_back(
        to_string(static_cast<Stage>(i)),
        time_statistics(column(frames_, [i](const LoggedFrame& f) { return f.stage_ms[i]; })));
  }
}

void RunLog::sum_up_latency(std::size_t dropped, const AsyncPipeline& pipeline) {
  std::vector<double> latencies;
  for (const LoggedFrame& frame : frames_) {
    if (frame.latency_ms) latencies.push_back(*frame.latency_ms);
  }
  if (latencies.empty()) return;
  metrics_.realtime = {time_statistics(latencies), maximum(latencies),
                       static_cast<std::int64_t>(dropped),
                       static_cast<std::int64_t>(pipeline.without_masks())};
}

void RunLog::sum_up_accuracy() {
  const Trajectory estimate = trajectory();
  metrics_.trajectory = error_of(truth_, estimate);
  if (!metrics_.trajectory) return;
  metrics_.drift = evaluate_drift(estimate);
  metrics_.stood_still = evaluate_drift(truth_).mtde_m < kStandsStill;
}

void RunLog::sum_up_loops(const GlobalMap& map) {
  if (map.records().empty()) return;
  const auto is_own = [&](std::size_t keyframe) {
    return map.records()[keyframe].session >= map.earlier_sessions();
  };
  for (std::size_t i = 0; i < map.records().size(); ++i) {
    loop_stamps_.push_back(map.records()[i].stamp);
    own_keyframes_.push_back(is_own(i));
  }
  std::copy_if(map.loops().begin(), map.loops().end(), std::back_inserter(loops_),
               [&](const Loop& loop) { return is_own(loop.query); });
  places_ = session_places(map, static_cast<std::uint32_t>(places_.size()));
  LoopMetrics& loops = metrics_.loops.emplace();
  if (places_.size() > 1) loops.sessions = session_metrics();
  loops.checked = static_cast<std::int64_t>(loops_.size());
  EarlierMapMetrics earlier;
  earlier.sessions = map.earlier_sessions();
  for (std::size_t i = 0; i < map.records().size(); ++i) {
    ++(is_own(i) ? loops.keyframes : earlier.keyframes);
  }
  for (const Loop& loop : loops_) {
    if (loop.outcome != LoopOutcome::kAccepted) continue;
    ++(is_own(loop.candidate) ? loops.closed : earlier.closed);
    const bool is_in_map =
        !is_own(loop.candidate) && map.is_joined(map.records()[loop.candidate].session);
    if (!is_in_map || earlier.localized_s) continue;
    earlier.localized_s = to_seconds(loop_stamps_[loop.query] - frames_.front().stamp);
  }
  if (map.earlier_sessions() > 0) loops.earlier_map = earlier;
  loops.relocalized = std::count_if(frames_.begin(), frames_.end(),
                                    [](const LoggedFrame& frame) { return frame.relocalized; });
  if (metrics_.trajectory) loops.trajectory = error_of(truth_, corrected_trajectory());
}

SessionMetrics RunLog::session_metrics() const {
  SessionMetrics metrics;
  metrics.begun = static_cast<std::int64_t>(places_.size());
  metrics.in_map = std::count_if(places_.begin(), places_.end(),
                                 [](const SessionPlace& place) { return place.is_known; });
  metrics.frames_outside =
      std::count_if(frames_.begin(), frames_.end(),
                    [&](const LoggedFrame& frame) { return !corrected_pose(frame); });
  return metrics;
}

void RunLog::compare_objects(const ObjectHistory& truth) {
  const ObjectHistory played = frames_during(truth, trajectory());
  if (played.empty()) return;
  const auto compare = [&](const ObjectHistory& objects,
                           const Trajectory& poses) -> std::optional<TrackingError> {
    const auto T = aligned_to(poses);
    if (!T) return std::nullopt;
    return evaluate_tracking(played, transformed(objects, T->inverse()), truth_);
  };
  metrics_.objects = compare(objects_, corrected_trajectory());
  metrics_.live_objects = compare(live_log_.read(), trajectory());
}

void RunLog::compare_map(const TruthCloud& truth, const std::vector<Eigen::Vector3f>& map) {
  const auto T = aligned_to(corrected_trajectory());
  if (T) metrics_.map = evaluate_labeled_map(truth.points, truth.labels, T->cast<float>(), map);
}

std::optional<Eigen::Isometry3d> RunLog::aligned_to(const Trajectory& poses) const {
  std::set<Timestamp> lost;
  for (const LoggedFrame& frame : frames_) {
    if (frame.status == Status::kLost) lost.insert(frame.stamp);
  }
  return align_truth(truth_, poses_without(poses, lost));
}

Trajectory RunLog::trajectory() const {
  Trajectory poses;
  for (const LoggedFrame& frame : frames_) poses.push_back({frame.stamp, frame.T_world_sensor});
  return poses;
}

Trajectory RunLog::corrected_trajectory() const {
  Trajectory poses;
  for (const LoggedFrame& frame : frames_) {
    const auto pose = corrected_pose(frame);
    if (pose) poses.push_back({frame.stamp, *pose});
  }
  return poses;
}

Trajectory RunLog::session_trajectory(std::uint32_t session) const {
  const PoseCorrection& correction = places_[session].correction;
  Trajectory poses;
  for (const LoggedFrame& frame : frames_) {
    if (frame.session != session || frame.is_searching) continue;
    const auto pose = correction.at(frame.stamp) * frame.T_world_sensor;
    poses.push_back({frame.stamp, Transform<World, Sensor>(pose.isometry())});
  }
  return poses;
}

std::optional<Transform<World, Sensor>> RunLog::corrected_pose(const LoggedFrame& frame) const {
  if (frame.is_searching) return std::nullopt;
  return places_[frame.session].corrected(frame.stamp, frame.T_world_sensor);
}

Trajectory RunLog::keyframes() const {
  Trajectory poses;
  for (const LoggedFrame& frame : frames_) {
    if (frame.keyframe) poses.push_back({frame.stamp, frame.T_world_sensor});
  }
  return poses;
}

}  // namespace mms
