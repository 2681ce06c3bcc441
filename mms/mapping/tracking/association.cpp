#include "mms/mapping/tracking/association.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mms/geometry/assignment.hpp"

namespace mms {
namespace {

/// [-]: standard deviations of a track's position to which its gate grows. Source: contain 95 % of
/// a normal distribution in one dimension.
constexpr double kGateSigmas = 2.0;

/// [m]: distance from the prediction up to which an object surely continues a track. Source: less
/// than two people are apart.
constexpr double kSureDistance = 0.35;

/// [-]: cost of a pair that is no candidate. Source: above any cost.
constexpr double kInfeasible = std::numeric_limits<double>::infinity();

double gate_of(const Track& track, const AssociationConfig& config) {
  if (!track.confirmed()) return config.gate_radius;  // may be a false detection
  const double sigma = std::sqrt(track.position_covariance().diagonal().maxCoeff());
  return std::clamp(kGateSigmas * sigma, config.gate_radius,
                    std::max(config.gate_radius, config.max_gate));
}

double cost_of(const Track& track, const ObjectMeasurement& object,
               const AssociationConfig& config) {
  const double distance = (track.fit(object).center - track.position()).norm();
  const bool is_near = distance <= gate_of(track, config);
  if (!is_near && !track.contains(object.centroid, 0.0)) return kInfeasible;
  double cost = distance / config.gate_radius;
  if (!may_be_one(track.object_class(), object.object_class)) cost += config.class_penalty;
  const std::optional<double> difference = track.appearance().difference(object.appearance);
  const bool is_back = distance > config.gate_radius;
  const double allowed = is_back ? config.returning_color_difference : config.max_color_difference;
  if (difference && *difference > allowed) return kInfeasible;
  return cost + config.color_penalty * difference.value_or(0.0);
}

/// Whether an object is where a known track is expected.
bool is_sure(const Track& track, const ObjectMeasurement& object) {
  return track.confirmed() && (track.fit(object).center - track.position()).norm() <= kSureDistance;
}

/// Where the largest cluster under a mask continues a track, the others under it continue none, but
/// those of known people: one mask often covers two who pass each other.
void exclude_rest(const std::vector<Track>& tracks, const std::vector<ObjectMeasurement>& objects,
                  std::vector<int>& track_of) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].largest || track_of[i] < 0) continue;
    const Track& track = tracks[static_cast<std::size_t>(track_of[i])];
    if (track.object_class() == ObjectClass::kPerson && is_sure(track, objects[i])) continue;
    for (std::size_t j = 0; j < objects.size(); ++j) {
      const bool is_its_largest = objects[j].largest && objects[j].instance == objects[i].instance;
      if (is_its_largest && track_of[j] >= 0) track_of[i] = -1;
    }
  }
}

/// The costs of objects near the predictions of confirmed tracks, which are assigned first. An
/// assignment of all makes as many pairs as possible: in a line of people whose first leaves and
/// whose last arrives, each would get the track of the one before.
Eigen::MatrixXd costs_of_sure_pairs(const std::vector<Track>& tracks,
                                    const std::vector<ObjectMeasurement>& objects,
                                    Eigen::MatrixXd cost) {
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    for (Eigen::Index j = 0; j < cost.cols(); ++j) {
      if (std::isfinite(cost(i, j)) &&
          !is_sure(tracks[static_cast<std::size_t>(j)], objects[static_cast<std::size_t>(i)])) {
        cost(i, j) = kInfeasible;
      }
    }
  }
  return cost;
}

}  // namespace

std::vector<int> associate(const std::vector<Track>& tracks,
                           const std::vector<ObjectMeasurement>& objects,
                           const AssociationConfig& config) {
  Eigen::MatrixXd cost(objects.size(), tracks.size());
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    for (Eigen::Index j = 0; j < cost.cols(); ++j) {
      cost(i, j) = cost_of(tracks[static_cast<std::size_t>(j)],
                           objects[static_cast<std::size_t>(i)], config);
    }
  }
  std::vector<int> track_of = assign_least_cost(costs_of_sure_pairs(tracks, objects, cost));
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    const int track = track_of[static_cast<std::size_t>(i)];
    if (track < 0) continue;
    cost.row(i).setConstant(kInfeasible);
    cost.col(track).setConstant(kInfeasible);
  }
  const std::vector<int> rest = assign_least_cost(cost);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] >= 0) track_of[i] = rest[i];
  }
  exclude_rest(tracks, objects, track_of);
  return track_of;
}

}  // namespace mms
