#include "mms/mapping/tracking/group_division.hpp"

#include <algorithm>
#include <utility>

#include "mms/geometry/principal_axes.hpp"

namespace mms {
namespace {

/// [-]: share of the points at either end that may be stray. Source: as in a box fit.
constexpr double kTrimmedShare = 0.02;

/// [-]: least points of a part, relative to an even share. Source: by experiment on the simulated
/// scenes; a person half hidden by the others still has as many.
constexpr double kMinPartShare = 0.4;

/// [-]: parts of a cluster. Source: with more people under one mask, parts hidden by others have
/// too few points.
constexpr std::size_t kMaxParts = 4;

/// [-]: rounds of Lloyd's algorithm. Source: means that begin evenly along the group's axis hardly
/// move after five.
constexpr int kLloydRounds = 5;

/// [-]: points that an extent is measured from. Source: as in an object's measurement.
constexpr std::size_t kMaxPoints = 400;

/// A point of a cluster and where it is on the floor.
struct FloorPoint {
  std::size_t index = 0;
  Eigen::Vector2d place;
};
using Group = std::vector<FloorPoint>;

Eigen::Vector2d mean_of(const Group& group) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const FloorPoint& point : group) sum += point.place;
  return sum / static_cast<double>(group.size());
}

/// The direction of a group's largest variance.
Eigen::Vector2d principal_axis(const Group& group) {
  return principal_axes(scatter_of(group, &FloorPoint::place).matrix).largest();
}

struct Ends {
  double low = 0.0;
  double high = 0.0;
};

/// The ends along an axis, without stray points.
Ends ends_along(const Group& group, const Eigen::Vector2d& axis) {
  std::vector<double> values;
  const std::size_t stride = 1 + (group.size() - 1) / kMaxPoints;
  for (std::size_t i = 0; i < group.size(); i += stride) values.push_back(axis.dot(group[i].place));
  const auto trimmed =
      static_cast<std::ptrdiff_t>(kTrimmedShare * static_cast<double>(values.size()));
  std::sort(values.begin(), values.end());
  return {*(values.begin() + trimmed), *(values.end() - 1 - trimmed)};
}

bool is_one(const Group& group, double max_extent) {
  const Ends ends = ends_along(group, principal_axis(group));
  return ends.high - ends.low <= max_extent;
}

std::size_t nearest(const std::vector<Eigen::Vector2d>& means, const Eigen::Vector2d& place) {
  const auto found = std::min_element(
      means.begin(), means.end(), [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        return (place - a).squaredNorm() < (place - b).squaredNorm();
      });
  return static_cast<std::size_t>(found - means.begin());
}

/// `count` parts around means that begin evenly along the group's axis; fewer where one is empty.
std::vector<Group> k_means(const Group& group, std::size_t count) {
  const Eigen::Vector2d axis = principal_axis(group);
  const Ends ends = ends_along(group, axis);
  const Eigen::Vector2d center = mean_of(group);
  std::vector<Eigen::Vector2d> means;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(count - 1);
    const double along = ends.low + share * (ends.high - ends.low);
    means.push_back(center + (along - axis.dot(center)) * axis);
  }
  std::vector<Group> parts;
  for (int round = 0; round < kLloydRounds; ++round) {
    parts.assign(means.size(), {});
    for (const FloorPoint& point : group) parts[nearest(means, point.place)].push_back(point);
    std::erase_if(parts, [](const Group& part) { return part.empty(); });
    means.clear();
    for (const Group& part : parts) means.push_back(mean_of(part));
  }
  return parts;
}

/// The fewest parts that are one object each.
std::vector<Group> divide(Group group, double max_extent) {
  const auto fits = [&](const Group& part) { return is_one(part, max_extent); };
  if (fits(group)) return {std::move(group)};
  std::vector<Group> best = {group};
  for (std::size_t count = 2; count <= kMaxParts; ++count) {
    std::vector<Group> parts = k_means(group, count);
    const std::size_t mean_size = group.size() / count;
    const double least = kMinPartShare * static_cast<double>(mean_size);
    const bool has_stray = std::any_of(parts.begin(), parts.end(), [&](const Group& part) {
      return static_cast<double>(part.size()) < least;
    });
    if (has_stray) break;
    best = std::move(parts);
    if (std::all_of(best.begin(), best.end(), fits)) break;
  }
  return best;
}

std::vector<Group> groups_of(const LabeledCloud& cloud,
                             const Transform<World, Sensor>& T_world_sensor,
                             const GroundFrame& ground) {
  const Eigen::Matrix<double, 2, 3> to_floor =
      (ground.axes(0.0).transpose() * T_world_sensor.rotation()).topRows<2>();
  std::vector<Group> groups(cloud.clusters.size());
  for (std::size_t i = 0; i < cloud.cluster.size(); ++i) {
    const int c = cloud.cluster[i];
    if (c < 0 || !cloud.points[i].allFinite()) continue;
    groups[static_cast<std::size_t>(c)].push_back({i, to_floor * cloud.points[i].cast<double>()});
  }
  return groups;
}

}  // namespace

ClusterParts divide_groups(const LabeledCloud& cloud,
                           const Transform<World, Sensor>& T_world_sensor,
                           const GroundFrame& ground, const TrackConfig& config) {
  ClusterParts result;
  result.part.assign(cloud.cluster.size(), -1);
  std::vector<Group> groups = groups_of(cloud, T_world_sensor, ground);
  for (std::size_t c = 0; c < groups.size(); ++c) {
    const auto object_class = static_cast<std::size_t>(cloud.clusters[c].object_class);
    std::vector<Group> parts(1);
    if (!groups[c].empty()) {
      parts = divide(std::move(groups[c]), config.classes[object_class].max_extent);
    }
    for (const Group& part : parts) {
      for (const FloorPoint& point : part) {
        result.part[point.index] = static_cast<std::int16_t>(result.cluster.size());
      }
      result.cluster.push_back(c);
    }
  }
  return result;
}

}  // namespace mms
