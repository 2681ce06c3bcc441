#include "mms/mapping/lost_tracks.hpp"

#include <algorithm>
#include <limits>

namespace mms {
namespace {

constexpr std::size_t kMost = 100;
constexpr double kClearlyLess = 0.7;  // of the difference from the second best
constexpr double kReach = 1.0;        // beyond the way that it can have gone [m]

double difference(const Track& a, const Track& b) {
  return a.appearance().difference(b.appearance()).value_or(std::numeric_limits<double>::max());
}

}  // namespace

void LostTracks::add(const Track& track) {
  if (lost_.size() == kMost) lost_.erase(lost_.begin());
  lost_.push_back(track);
}

void LostTracks::forget(Timestamp now) {
  std::erase_if(lost_, [&](const Track& track) {
    return to_seconds(now - track.last_seen()) > config_.max_away;
  });
}

void LostTracks::drop(int id) {
  std::erase_if(lost_, [&](const Track& track) { return track.id() == id; });
}

std::optional<Track> LostTracks::take(const Track& track) {
  double least = config_.max_color_difference;
  double second = std::numeric_limits<double>::max();
  auto best = lost_.end();
  for (auto lost = lost_.begin(); lost != lost_.end(); ++lost) {
    if (!could_be(*lost, track)) continue;
    const double now = difference(*lost, track);
    if (now <= least) {
      if (best != lost_.end()) second = least;
      least = now;
      best = lost;
    } else {
      second = std::min(second, now);
    }
  }
  if (best == lost_.end() || least >= kClearlyLess * second) return std::nullopt;
  const Track found = *best;
  lost_.erase(best);
  return found;
}

bool LostTracks::could_be(const Track& lost, const Track& track) const {
  const double seconds = to_seconds(track.last_seen() - lost.last_seen());
  const double way = (track.position() - lost.last_position()).norm();
  return way <= kReach + config_.speed * seconds;
}

}  // namespace mms
