#include "mms/evaluation/tracking/tracking_error.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "mms/evaluation/scores/statistics.hpp"
#include "mms/evaluation/tracking/motion_state_latency.hpp"
#include "mms/evaluation/tracking/object_pairing.hpp"

namespace mms {
namespace {

template <class Stamped>
std::map<Timestamp, const Stamped*> by_stamp(const std::vector<Stamped>& items) {
  std::map<Timestamp, const Stamped*> found;
  for (const Stamped& item : items) found[item.stamp] = &item;
  return found;
}

/// Object of a track: one that counts, another one, or none.
enum class Owner { kNobody, kCounted, kOther };

class Comparison {
 public:
  explicit Comparison(const TrackingOptions& options)
      : options_(options), pairing_(options.match_distance) {}

  void add(Timestamp stamp, const std::vector<ObjectBox>& truth,
           const std::vector<ObjectBox>& tracks, const Eigen::Vector3d& sensor) {
    // Pairs all objects; else the track of one that does not count could be paired with its
    // neighbor.
    const std::vector<int> pairs = pairing_.pair(truth, tracks);
    std::vector<ObjectBox> counted;
    std::vector<ObjectBox> others;
    std::vector<Owner> owners(tracks.size(), Owner::kNobody);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const bool counts = in_range(truth[i], sensor) && truth[i].visible >= options_.min_visible;
      const ObjectBox* track = nullptr;
      if (pairs[i] >= 0) {
        const auto paired = static_cast<std::size_t>(pairs[i]);
        track = &tracks[paired];
        owners[paired] = counts ? Owner::kCounted : Owner::kOther;
      }
      (counts ? counted : others).push_back(truth[i]);
      if (counts) {
        see(stamp, truth[i], track);
      } else {
        turns_.lose(truth[i].id);
      }
    }
    objects_ += static_cast<std::int64_t>(counted.size());
    count_tracks(counted, others, tracks, owners, sensor);
  }

  TrackingError result() {
    turns_.finish();
    TrackingError error;
    const auto paired = static_cast<std::int64_t>(offsets_.size());
    error.objects = objects_;
    error.recall = ratio(paired, objects_);
    error.false_discovery_rate = ratio(tracks_ - paired, tracks_);
    error.id_switches = switches_;
    error.idf1 = ratio(2 * best_identity_matches(met_), objects_ + tracks_);
    error.center_mean = mean(offsets_);
    error.center_median = percentile(offsets_, 50.0);
    error.velocity_rmse = std::sqrt(mean(squared_velocity_errors_));
    error.motion_state_changes = turns_.count();
    error.motion_state_delay_max = turns_.longest();
    return error;
  }

 private:
  bool in_range(const ObjectBox& object, const Eigen::Vector3d& sensor) const {
    const double range = (object.center() - sensor).norm();
    return range >= options_.min_range && range <= options_.max_range;
  }

  bool is_near(const ObjectBox& a, const ObjectBox& b) const {
    return (a.center() - b.center()).norm() <= options_.match_distance;
  }

  void see(Timestamp stamp, const ObjectBox& truth, const ObjectBox* track) {
    if (track != nullptr) compare(truth, *track);
    turns_.see(truth.id, stamp, truth.moving, track != nullptr && track->moving == truth.moving);
  }

  void compare(const ObjectBox& truth, const ObjectBox& track) {
    offsets_.push_back((truth.center() - track.center()).norm());
    squared_velocity_errors_.push_back((truth.velocity - track.velocity).squaredNorm());
    const auto [last, is_new] = last_track_.try_emplace(truth.id, track.id);
    if (!is_new && last->second != track.id) ++switches_;
    last->second = track.id;
  }

  void count_tracks(const std::vector<ObjectBox>& counted, const std::vector<ObjectBox>& others,
                    const std::vector<ObjectBox>& tracks, const std::vector<Owner>& owners,
                    const Eigen::Vector3d& sensor) {
    const auto is_excused = [&](const ObjectBox& track) {
      return !in_range(track, sensor) ||
             std::any_of(others.begin(), others.end(),
                         [&](const ObjectBox& other) { return is_near(other, track); });
    };
    for (std::size_t j = 0; j < tracks.size(); ++j) {
      if (owners[j] == Owner::kOther) continue;
      if (owners[j] == Owner::kNobody && is_excused(tracks[j])) continue;
      ++tracks_;
      for (const ObjectBox& object : counted) {
        if (is_near(object, tracks[j])) ++met_[{object.id, tracks[j].id}];
      }
    }
  }

  TrackingOptions options_;
  ObjectPairing pairing_;
  MotionStateLatency turns_;
  PairCounts met_;
  std::map<int, int> last_track_;  // by id of the ground-truth object
  std::vector<double> offsets_;
  std::vector<double> squared_velocity_errors_;
  std::int64_t objects_ = 0;
  std::int64_t tracks_ = 0;
  std::int64_t switches_ = 0;
};

}  // namespace

TrackingError evaluate_tracking(const ObjectHistory& truth, const ObjectHistory& tracks,
                                const Trajectory& sensor, const TrackingOptions& options) {
  const auto tracks_at = by_stamp(tracks);
  const auto pose_at = by_stamp(sensor);
  Comparison comparison(options);
  for (const ObjectFrame& frame : truth) {
    const auto pose = pose_at.find(frame.stamp);
    if (pose == pose_at.end()) continue;
    const auto found = tracks_at.find(frame.stamp);
    comparison.add(frame.stamp, frame.objects,
                   found == tracks_at.end() ? std::vector<ObjectBox>{} : found->second->objects,
                   pose->second->T_world_sensor.translation());
  }
  return comparison.result();
}

ObjectHistory frames_during(ObjectHistory history, const Trajectory& poses) {
  std::erase_if(history, [&](const ObjectFrame& frame) {
    return poses.empty() || frame.stamp < poses.front().stamp || poses.back().stamp < frame.stamp;
  });
  return history;
}

std::vector<MetricValue> metric_values(const TrackingError& error) {
  return {
      {"objects", "ground-truth objects", static_cast<double>(error.objects), "", 0},
      {"idf1_pct", "IDF1", 100.0 * error.idf1, "%", 1},
      {"recall_pct", "recall of objects", 100.0 * error.recall, "%", 1},
      {"false_discovery_pct", "false discovery rate", 100.0 * error.false_discovery_rate, "%", 1},
      {"id_switches", "ID switches", static_cast<double>(error.id_switches), "", 0},
      {"center_mean_m", "box center error, mean", error.center_mean, "m", 3},
      {"center_median_m", "box center error, median", error.center_median, "m", 3},
      {"velocity_rmse_mps", "velocity error, rmse", error.velocity_rmse, "m/s", 3},
      {"motion_state_changes", "motion-state changes",
       static_cast<double>(error.motion_state_changes), "", 0},
      {"motion_state_delay_max_s", "longest motion-state delay", error.motion_state_delay_max, "s",
       2}};
}

ObjectHistory transformed(ObjectHistory history, const Eigen::Isometry3d& T_to_from) {
  for (ObjectFrame& frame : history) {
    for (ObjectBox& object : frame.objects) {
      object.T_world_box = T_to_from * object.T_world_box;
      object.velocity = T_to_from.linear() * object.velocity;
    }
  }
  return history;
}

}  // namespace mms
