#include "mms/mapping/association.hpp"

#include <algorithm>
#include <tuple>

namespace mms {
namespace {

struct Pair {
  double distance = 0.0;  // to the prediction [m]
  int track = 0;
  int object = 0;
};

bool nearer(const Pair& a, const Pair& b) {
  return std::tie(a.distance, a.track, a.object) < std::tie(b.distance, b.track, b.object);
}

std::vector<Pair> gated_pairs(const std::vector<Track>& tracks,
                              const std::vector<ObjectObservation>& objects,
                              const AssociationConfig& config) {
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    if (tracks[t].state == TrackState::kEnded) continue;
    const ObjectObservation& last = tracks[t].history.back();
    for (std::size_t o = 0; o < objects.size(); ++o) {
      const double reach = config.max_speed * to_seconds(objects[o].stamp - last.stamp);
      const double moved = (objects[o].centroid - last.centroid).norm();
      const double off = (objects[o].centroid - tracks[t].predicted(objects[o].stamp)).norm();
      if (off > config.gate_radius || moved > reach + config.gate_radius) continue;
      pairs.push_back({off, static_cast<int>(t), static_cast<int>(o)});
    }
  }
  std::sort(pairs.begin(), pairs.end(), nearer);
  return pairs;
}

}  // namespace

std::vector<int> associate(const std::vector<Track>& tracks,
                           const std::vector<ObjectObservation>& objects,
                           const AssociationConfig& config) {
  std::vector<int> track_of(objects.size(), -1);
  std::vector<bool> taken(tracks.size(), false);
  for (const Pair& pair : gated_pairs(tracks, objects, config)) {
    int& track = track_of[static_cast<std::size_t>(pair.object)];
    if (track >= 0 || taken[static_cast<std::size_t>(pair.track)]) continue;
    track = pair.track;
    taken[static_cast<std::size_t>(pair.track)] = true;
  }
  return track_of;
}

}  // namespace mms
