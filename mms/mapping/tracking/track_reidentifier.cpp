#include "mms/mapping/tracking/track_reidentifier.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mms {
namespace {

constexpr std::size_t kMost = 100;
constexpr double kStay = 1.0;  // of whoever stays where he is [m]

// Differences of looks, measured on simulated people of other seeds than those of the tests: of one
// who comes back, of two, and the standard deviation of both.
constexpr double kOfOne = 0.38;
constexpr double kOfTwo = 0.76;
constexpr double kSigma = 0.12;

/// How much more probable a difference of looks is of one object than of two. Nobody is surer for
/// being more alike than one who comes back mostly is.
double appearance_likelihood_ratio(double difference) {
  const double d = std::max(difference, kOfOne);
  const auto square = [](double x) { return x * x; };
  return std::exp((square(d - kOfTwo) - square(d - kOfOne)) / (2.0 * square(kSigma)));
}

/// Normal density over the floor at that distance from its center [1/m^2].
double density(double distance, double sigma) {
  const double variance = sigma * sigma;
  return std::exp(-0.5 * distance * distance / variance) / (2.0 * std::numbers::pi * variance);
}

}  // namespace

void TrackReidentifier::add(const Track& track) {
  if (lost_.size() == kMost) lost_.erase(lost_.begin());
  lost_.push_back(track);
}

void TrackReidentifier::forget(Timestamp now) {
  std::erase_if(lost_, [&](const Track& track) {
    return to_seconds(now - track.last_seen()) > config_.max_away;
  });
}

void TrackReidentifier::drop(int id) {
  std::erase_if(lost_, [&](const Track& track) { return track.id() == id; });
}

std::optional<Track> TrackReidentifier::take(const Track& track) {
  double all = config_.new_object_density;
  double most = 0.0;
  auto best = lost_.end();
  for (auto lost = lost_.begin(); lost != lost_.end(); ++lost) {
    const double now = likelihood(*lost, track);
    all += now;
    if (now <= most) continue;
    most = now;
    best = lost;
  }
  if (best == lost_.end() || most < config_.min_probability * all) return std::nullopt;
  const Track found = *best;
  lost_.erase(best);
  return found;
}

/// Against somebody never seen before, whose density over the floor is that of `new_object_density`
/// [1/m^2]. Half of all stay where they are, half go on.
double TrackReidentifier::likelihood(const Track& lost, const Track& track) const {
  const std::optional<double> difference = lost.appearance().difference(track.appearance());
  if (!difference || !may_be_one(lost.object_class(), track.object_class())) return 0.0;
  const double seconds = to_seconds(track.last_seen() - lost.last_seen());
  const double way = (track.position() - lost.last_position()).norm();
  const double there = 0.5 * (density(way, kStay) + density(way, kStay + config_.spread * seconds));
  return appearance_likelihood_ratio(*difference) * there;
}

}  // namespace mms
