#include "mms/mapping/tracking/dynamic_map.hpp"

#include <algorithm>

namespace mms {
namespace {

/// [m]: margin around a track's box in which a masked cluster is a part of its object. Source:
/// three standard deviations of a box's center (`position_sigma`).
constexpr double kPartMargin = 0.1;

/// [m]: the same for moving clusters without a mask. Source: half the length of an arm, which
/// reaches out of a person's box.
constexpr double kUnmaskedPartMargin = 0.3;

/// [-]: share of a cluster's points in another object's box from which the cluster is of both.
/// Source: by experiment on the simulated scenes; half of what two equal objects would share.
constexpr double kMinSharedPart = 0.25;

/// Up in the first sensor's frame, which is the world's: cameras are assumed level, LiDARs upright.
Eigen::Vector3d nominal_up(const LabeledCloud& cloud) {
  return cloud.organised() ? Eigen::Vector3d(0.0, -1.0, 0.0) : Eigen::Vector3d(0.0, 0.0, 1.0);
}

}  // namespace

void DynamicMap::update(const LabeledCloud& cloud, const OdometryEstimate& odometry) {
  if (cloud.stamp <= last_stamp_ || !odometry.T_world_sensor.is_finite()) return;
  last_stamp_ = cloud.stamp;
  prune();
  update_ground(cloud, odometry.T_world_sensor);
  for (Track& track : tracks_) {
    track.set_ground(*ground_);
    track.predict(cloud.stamp);
  }
  const std::vector<ObjectMeasurement> objects =
      measure_objects(cloud, odometry.T_world_sensor, *ground_, config_.track);
  const std::vector<int> track_of = associate(tracks_, objects, config_.association);
  extend(objects, track_of);
  begin_new(objects, track_of);
  confirm_seen();
}

void DynamicMap::prune() {
  for (const Track& track : tracks_) {
    if (track.confirmed() && is_over(track)) lost_.add(track);
  }
  std::erase_if(tracks_, [&](const Track& track) { return is_over(track); });
  lost_.forget(last_stamp_);
}

bool DynamicMap::is_over(const Track& track) const {
  return track.confirmed()
             ? to_seconds(last_stamp_ - track.last_seen()) > config_.max_missed
             : to_seconds(last_stamp_ - track.last_evidence()) > config_.max_tentative;
}

void DynamicMap::update_ground(const LabeledCloud& cloud,
                               const Transform<World, Sensor>& T_world_sensor) {
  // An empty cloud does not tell the sensor.
  if (!ground_ || !cloud.points.empty()) ground_.emplace(nominal_up(cloud));
  floor_tracker_.update(cloud, T_world_sensor, ground_->up());
  const std::optional<Floor>& floor = floor_tracker_.floor();
  if (floor) ground_.emplace(floor->up, floor->height);
}

void DynamicMap::extend(const std::vector<ObjectMeasurement>& objects,
                        const std::vector<int>& track_of) {
  std::vector<bool> has_own(tracks_.size(), false);
  for (const int t : track_of) {
    if (t >= 0) has_own[static_cast<std::size_t>(t)] = true;
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (track_of[i] < 0) continue;
    const auto t = static_cast<std::size_t>(track_of[i]);
    tracks_[t].update(objects[i], is_shared(objects[i], has_own));
  }
}

void DynamicMap::begin_new(const std::vector<ObjectMeasurement>& objects,
                           const std::vector<int>& track_of) {
  std::vector<int> followed;  // masks of which a part other than the largest has a track
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!objects[i].largest && track_of[i] >= 0) followed.push_back(objects[i].instance);
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const bool is_spilled =
        std::find(followed.begin(), followed.end(), objects[i].instance) != followed.end();
    if (!objects[i].largest || is_spilled) continue;
    // A cluster that has neither a mask nor motion of its own begins no track.
    const bool has_evidence =
        objects[i].score > 0.0F || objects[i].object_class == ObjectClass::kUnknown;
    if (track_of[i] >= 0 || !has_evidence || is_part_of_a_track(objects[i])) continue;
    tracks_.emplace_back(next_id_++, objects[i], *ground_, config_.track);
  }
}

void DynamicMap::confirm_seen() {
  std::vector<int> back;
  for (Track& track : tracks_) {
    if (track.confirmed() || track.last_seen() != last_stamp_ || !is_sure(track)) continue;
    if (const std::optional<Track> lost = reidentify(track, back)) {
      track.continue_as(*lost);
      back.push_back(track.id());
    } else {
      track.confirm();
      ++confirmed_;
    }
  }
  std::erase_if(tracks_, [&](const Track& track) {
    return track.last_seen() != last_stamp_ &&
           std::find(back.begin(), back.end(), track.id()) != back.end();
  });
}

bool DynamicMap::is_sure(const Track& track) const {
  const auto& prior = config_.track.classes[static_cast<std::size_t>(track.object_class())];
  const bool is_named =
      track.observations() >= config_.confirm_after && track.score() >= prior.min_score;
  return is_named || track.motion_detections() >= config_.confirm_unknown_after;
}

/// The object that `track` continues: one that was lost, or is out of view and predicted elsewhere.
/// @param back  ids of those that another track of this frame continues
std::optional<Track> DynamicMap::reidentify(const Track& track, const std::vector<int>& back) {
  TrackReidentifier away = lost_;
  for (const Track& other : tracks_) {
    const bool is_back = std::find(back.begin(), back.end(), other.id()) != back.end();
    if (other.confirmed() && other.last_seen() != last_stamp_ && !is_back) away.add(other);
  }
  std::optional<Track> taken = away.take(track);
  if (taken) lost_.drop(taken->id());
  return taken;
}

bool DynamicMap::is_part_of_a_track(const ObjectMeasurement& object) const {
  const bool is_named = object.object_class != ObjectClass::kUnknown;
  return std::any_of(tracks_.begin(), tracks_.end(), [&](const Track& track) {
    return (track.confirmed() || !is_named) && track.last_seen() == object.stamp &&
           track.contains(object.centroid, is_named ? kPartMargin : kUnmaskedPartMargin);
  });
}

/// Whether the points also cover the predicted box of another object without a measurement.
bool DynamicMap::is_shared(const ObjectMeasurement& object,
                           const std::vector<bool>& has_own) const {
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    if (has_own[t] || !tracks_[t].confirmed()) continue;
    const auto inside = std::count_if(
        object.points.begin(), object.points.end(),
        [&](const Eigen::Vector3d& point) { return tracks_[t].contains(point, 0.0); });
    if (kMinSharedPart * static_cast<double>(object.points.size()) < static_cast<double>(inside)) {
      return true;
    }
  }
  return false;
}

std::vector<TrackedObject> DynamicMap::objects() const {
  std::vector<TrackedObject> objects;
  for (const Track& track : tracks_) {
    if (!track.confirmed()) continue;
    // An object seen for a short time only is not given for longer than that while unseen.
    const double known = to_seconds(track.last_seen() - track.first_seen());
    const double unseen = to_seconds(last_stamp_ - track.last_seen());
    if (unseen > std::min(config_.max_coast_output, known)) continue;
    const bool seen = track.last_seen() == last_stamp_;
    objects.push_back({track.box(), seen ? TrackState::kActive : TrackState::kCoasting,
                       track.motion(), track.first_seen(), track.last_seen()});
  }
  std::ranges::sort(objects, {}, [](const TrackedObject& object) { return object.box.id; });
  return objects;
}

}  // namespace mms
