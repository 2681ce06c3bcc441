#include "mms/mapping/dynamic_map.hpp"

#include <algorithm>

#include "mms/mapping/observations.hpp"

namespace mms {
namespace {

/// Slope of the line fitted to the centroids of the last `window` seconds [m/s]; at least the last
/// two count.
Eigen::Vector3d fitted_velocity(const std::vector<ObjectObservation>& history, double window) {
  if (history.size() < 2) return Eigen::Vector3d::Zero();
  const ObjectObservation& last = history.back();
  double n = 0.0;
  double sum_t = 0.0;
  double sum_tt = 0.0;
  Eigen::Vector3d sum_p = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum_tp = Eigen::Vector3d::Zero();
  for (auto it = history.rbegin(); it != history.rend(); ++it) {
    const double t = to_seconds(it->stamp - last.stamp);
    if (n >= 2.0 && -t > window) break;
    const Eigen::Vector3d p = it->centroid - last.centroid;
    n += 1.0;
    sum_t += t;
    sum_tt += t * t;
    sum_p += p;
    sum_tp += t * p;
  }
  return (n * sum_tp - sum_t * sum_p) / (n * sum_tt - sum_t * sum_t);
}

ObjectClass most_voted(const std::array<int, kObjectClassCount>& votes) {
  return static_cast<ObjectClass>(std::max_element(votes.begin(), votes.end()) - votes.begin());
}

}  // namespace

void DynamicMap::update(const LabeledCloud& cloud, const OdometryEstimate& odometry) {
  if (cloud.stamp <= last_stamp_ || !odometry.T_world_sensor.is_finite()) return;
  last_stamp_ = cloud.stamp;
  const std::vector<ObjectObservation> objects = observe_objects(cloud, odometry.T_world_sensor);
  const std::vector<int> track_of = associate(tracks_, objects, config_.association);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (track_of[i] >= 0) {
      extend(tracks_[static_cast<std::size_t>(track_of[i])], objects[i]);
    } else {
      begin(objects[i]);
    }
  }
  age(cloud.stamp);
}

void DynamicMap::begin(const ObjectObservation& object) {
  Track& track = tracks_.emplace_back();
  track.id = next_id_++;
  extend(track, object);
}

void DynamicMap::extend(Track& track, const ObjectObservation& object) const {
  track.history.push_back(object);
  track.velocity = fitted_velocity(track.history, config_.velocity_window);
  const double speed = track.velocity.norm();
  const double limit = config_.association.max_speed;
  if (speed > limit) track.velocity *= limit / speed;
  track.history.back().velocity = track.velocity;
  ++track.votes[static_cast<std::size_t>(object.object_class)];
  track.object_class = most_voted(track.votes);
}

void DynamicMap::age(Timestamp now) {
  for (Track& track : tracks_) {
    if (track.state == TrackState::kEnded) continue;
    const double unseen = to_seconds(now - track.history.back().stamp);
    const bool confirmed = static_cast<int>(track.history.size()) >= config_.confirm_after;
    if (unseen > config_.max_missed) {
      track.state = TrackState::kEnded;
    } else if (confirmed) {
      track.state = unseen > 0.0 ? TrackState::kCoasting : TrackState::kActive;
    }
  }
  std::erase_if(tracks_, [&](const Track& track) {
    return track.state == TrackState::kEnded &&
           static_cast<int>(track.history.size()) < config_.confirm_after;
  });
}

std::vector<Track> DynamicMap::active() const {
  std::vector<Track> result;
  for (const Track& track : tracks_) {
    if (track.state != TrackState::kActive && track.state != TrackState::kCoasting) continue;
    Track& copy = result.emplace_back();  // not of the whole history, which can be long
    copy.id = track.id;
    copy.state = track.state;
    copy.object_class = track.object_class;
    copy.velocity = track.velocity;
    copy.votes = track.votes;
    copy.history.push_back(track.history.back());
  }
  return result;
}

}  // namespace mms
