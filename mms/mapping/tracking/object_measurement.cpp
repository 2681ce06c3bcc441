#include "mms/mapping/tracking/object_measurement.hpp"

#include <algorithm>

#include "mms/mapping/tracking/truncation.hpp"

namespace mms {
namespace {

/// [-]: points measured of an object. Source: bounds the time; the 2 % at either end that may be
/// stray are still eight.
constexpr std::size_t kMaxPoints = 400;

/// Step between the measured points of a cluster.
std::size_t stride_of(std::size_t points) {
  return 1 + (points - 1) / kMaxPoints;
}

/// Whether most of these points are on static surfaces of recent views.
bool is_overruled(const LabeledCloud& cloud, const std::vector<std::size_t>& indices) {
  if (cloud.overruled.empty()) return false;
  const auto overruled = std::count_if(indices.begin(), indices.end(),
                                       [&](std::size_t i) { return cloud.overruled[i] != 0; });
  return 2 * static_cast<std::size_t>(overruled) > indices.size();
}

/// Indices of every part's points.
std::vector<std::vector<std::size_t>> members(const ClusterParts& parts) {
  std::vector<std::vector<std::size_t>> lists(parts.cluster.size());
  for (std::size_t i = 0; i < parts.part.size(); ++i) {
    const int p = parts.part[i];
    if (p >= 0) lists[static_cast<std::size_t>(p)].push_back(i);
  }
  return lists;
}

/// Whether no cluster before it is under the same mask.
bool is_largest(const LabeledCloud& cloud, std::size_t cluster) {
  const int instance = cloud.clusters[cluster].instance;
  const auto begin = cloud.clusters.begin();
  return instance < 0 ||
         std::none_of(begin, begin + static_cast<std::ptrdiff_t>(cluster),
                      [&](const DynamicCluster& other) { return other.instance == instance; });
}

/// Points and center in the world frame.
void measure_points(const LabeledCloud& cloud, const std::vector<std::size_t>& indices,
                    const Transform<World, Sensor>& T_world_sensor, ObjectMeasurement& object) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::size_t stride = stride_of(indices.size());
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const Eigen::Vector3d point = cloud.points[indices[k]].cast<double>();
    sum += point;
    if (k % stride == 0) object.points.emplace_back(T_world_sensor * point);
  }
  object.centroid = T_world_sensor * (sum / static_cast<double>(indices.size()));
}

/// Points of a scan that the camera does not see are black.
bool has_color(const LabeledCloud& cloud, std::size_t i) {
  return cloud.organised() || cloud.colors[i] != Rgb{};
}

void measure_colors(const LabeledCloud& cloud, const std::vector<std::size_t>& indices,
                    const GroundFrame& ground, ObjectMeasurement& object) {
  if (cloud.colors.empty()) return;
  std::vector<double> heights;
  for (const Eigen::Vector3d& point : object.points) heights.push_back(ground.up().dot(point));
  const double floor = ground.floor().value_or(*std::min_element(heights.begin(), heights.end()));
  const std::size_t stride = stride_of(indices.size());
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const Rgb& color = cloud.colors[indices[k * stride]];
    if (!has_color(cloud, indices[k * stride])) continue;
    object.appearance.add(heights[k] - floor, Eigen::Vector3f(color.r, color.g, color.b));
  }
}

}  // namespace

std::vector<ObjectMeasurement> measure_objects(const LabeledCloud& cloud,
                                               const Transform<World, Sensor>& T_world_sensor,
                                               const GroundFrame& ground,
                                               const TrackConfig& config) {
  const ClusterParts parts = divide_groups(cloud, T_world_sensor, ground, config);
  const auto indices = members(parts);
  std::vector<ObjectMeasurement::Truncation> truncations(parts.cluster.size());
  if (cloud.organised()) truncations = find_truncations(cloud, parts);
  std::vector<ObjectMeasurement> objects;
  for (std::size_t p = 0; p < parts.cluster.size(); ++p) {
    if (indices[p].empty()) continue;
    const DynamicCluster& cluster = cloud.clusters[parts.cluster[p]];
    ObjectMeasurement& object = objects.emplace_back();
    object.stamp = cloud.stamp;
    object.object_class = cluster.object_class;
    object.score = is_overruled(cloud, indices[p]) ? 0.0F : cluster.score;
    object.instance = cluster.instance;
    object.largest = is_largest(cloud, parts.cluster[p]);
    object.sensor = T_world_sensor.translation();
    object.right = T_world_sensor.rotation().col(0);
    object.truncation = truncations[p];
    measure_points(cloud, indices[p], T_world_sensor, object);
    measure_colors(cloud, indices[p], ground, object);
  }
  return objects;
}

}  // namespace mms
