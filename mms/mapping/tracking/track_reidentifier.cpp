#include "mms/mapping/tracking/track_reidentifier.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mms {
namespace {

/// [-]: lost tracks that are kept. Source: bounds memory and time; more than pass a robot in the 60
/// s of `max_away`.
constexpr std::size_t kMaxLost = 100;

/// [m]: standard deviation of the position of an object that stays in place. Source: about two
/// steps of a person at work.
constexpr double kStationarySigma = 1.0;

/// [-]: mean appearance difference between views of one person. Source: measured on simulated
/// people of other seeds than those of the tests.
constexpr double kMeanDifferenceSame = 0.38;

/// [-]: mean appearance difference between two persons. Source: the same measurement.
constexpr double kMeanDifferenceOther = 0.76;

/// [-]: standard deviation of both differences. Source: the same measurement.
constexpr double kDifferenceSigma = 0.12;

/// Likelihood ratio of an appearance difference: of one object to two objects. A difference below
/// the mean of one object counts as that mean.
double appearance_likelihood_ratio(double difference) {
  const double d = std::max(difference, kMeanDifferenceSame);
  const auto square = [](double x) { return x * x; };
  return std::exp((square(d - kMeanDifferenceOther) - square(d - kMeanDifferenceSame)) /
                  (2.0 * square(kDifferenceSigma)));
}

/// Normal density over the floor at that distance from its center [1/m^2].
double density(double distance, double sigma) {
  const double variance = sigma * sigma;
  return std::exp(-0.5 * distance * distance / variance) / (2.0 * std::numbers::pi * variance);
}

}  // namespace

void TrackReidentifier::add(const Track& track) {
  if (lost_.size() == kMaxLost) lost_.erase(lost_.begin());
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
    const double current = likelihood(*lost, track);
    all += current;
    if (current <= most) continue;
    most = current;
    best = lost;
  }
  if (best == lost_.end() || most < config_.min_probability * all) return std::nullopt;
  const Track found = *best;
  lost_.erase(best);
  return found;
}

/// Likelihood that `track` continues `lost`, to be compared with `new_object_density` [1/m^2], that
/// of an object never seen before. Equal priors: the object stayed in place, or it moved on.
double TrackReidentifier::likelihood(const Track& lost, const Track& track) const {
  const std::optional<double> difference = lost.appearance().difference(track.appearance());
  if (!difference || !may_be_one(lost.object_class(), track.object_class())) return 0.0;
  const double seconds = to_seconds(track.last_seen() - lost.last_seen());
  const double distance = (track.position() - lost.last_position()).norm();
  const double moved_sigma = kStationarySigma + config_.spread * seconds;
  const double position =
      0.5 * (density(distance, kStationarySigma) + density(distance, moved_sigma));
  return appearance_likelihood_ratio(*difference) * position;
}

}  // namespace mms
