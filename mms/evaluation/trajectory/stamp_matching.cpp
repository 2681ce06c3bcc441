#include "mms/evaluation/trajectory/stamp_matching.hpp"

#include <algorithm>
#include <optional>

namespace mms {
namespace {

/// Indices of the finite poses, ordered by stamp.
std::vector<std::size_t> finite_by_stamp(const Trajectory& trajectory) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (trajectory[i].T_world_sensor.is_finite()) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return trajectory[a].stamp < trajectory[b].stamp;
  });
  return order;
}

Duration gap(Timestamp a, Timestamp b) {
  return a < b ? b - a : a - b;
}

/// Index in `order` (not empty, sorted by stamp) of the pose nearest to `stamp`; the earlier one of
/// equals.
std::size_t nearest(const Trajectory& trajectory, const std::vector<std::size_t>& order,
                    Timestamp stamp) {
  const auto later =
      std::lower_bound(order.begin(), order.end(), stamp,
                       [&](std::size_t i, Timestamp value) { return trajectory[i].stamp < value; });
  if (later == order.begin()) return 0;
  const auto earlier = later - 1;
  const bool take_later = later != order.end() && gap(trajectory[*later].stamp, stamp) <
                                                      gap(trajectory[*earlier].stamp, stamp);
  return static_cast<std::size_t>((take_later ? later : earlier) - order.begin());
}

}  // namespace

std::vector<PoseMatch> match_by_stamp(const Trajectory& reference, const Trajectory& estimate,
                                      Duration max_difference) {
  const std::vector<std::size_t> references = finite_by_stamp(reference);
  if (references.empty()) return {};
  std::vector<std::optional<std::size_t>> winners(references.size());
  for (const std::size_t candidate : finite_by_stamp(estimate)) {
    const Timestamp stamp = estimate[candidate].stamp;
    const std::size_t place = nearest(reference, references, stamp);
    const Timestamp target = reference[references[place]].stamp;
    if (gap(stamp, target) > max_difference) continue;
    std::optional<std::size_t>& winner = winners[place];
    if (!winner || gap(stamp, target) < gap(estimate[*winner].stamp, target)) winner = candidate;
  }
  std::vector<PoseMatch> matches;
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (winners[i]) matches.push_back({references[i], *winners[i]});
  }
  return matches;
}

std::vector<PoseMatch> match_by_index(const Trajectory& reference, const Trajectory& estimate) {
  std::vector<PoseMatch> matches;
  for (std::size_t i = 0; i < std::min(reference.size(), estimate.size()); ++i) {
    const bool finite =
        reference[i].T_world_sensor.is_finite() && estimate[i].T_world_sensor.is_finite();
    if (finite) matches.push_back({i, i});
  }
  return matches;
}

}  // namespace mms
