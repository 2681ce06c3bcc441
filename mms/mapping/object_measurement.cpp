#include "mms/mapping/object_measurement.hpp"

#include <algorithm>

#include "mms/mapping/cluster_cuts.hpp"

namespace mms {
namespace {

constexpr std::size_t kMaxPoints = 400;

/// Indices of every cluster's points.
std::vector<std::vector<std::size_t>> members(const LabeledCloud& cloud) {
  std::vector<std::vector<std::size_t>> lists(cloud.clusters.size());
  for (std::size_t i = 0; i < cloud.cluster.size(); ++i) {
    const int c = cloud.cluster[i];
    if (c >= 0 && cloud.points[i].allFinite()) lists[static_cast<std::size_t>(c)].push_back(i);
  }
  return lists;
}

bool is_secondary(const LabeledCloud& cloud, std::size_t cluster) {
  const int instance = cloud.clusters[cluster].instance;
  const auto begin = cloud.clusters.begin();
  return instance >= 0 &&
         std::any_of(begin, begin + static_cast<std::ptrdiff_t>(cluster),
                     [&](const DynamicCluster& other) { return other.instance == instance; });
}

std::vector<Eigen::Vector3d> corners(const DynamicCluster& cluster) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Array3f high(static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                              static_cast<float>(i >> 2));
    const Eigen::Vector3f corner =
        cluster.box_min.array() + high * (cluster.box_max - cluster.box_min).array();
    points.emplace_back(corner.cast<double>());
  }
  return points;
}

void measure_points(const LabeledCloud& cloud, const std::vector<std::size_t>& indices,
                    ObjectMeasurement& object) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3f color = Eigen::Vector3f::Zero();
  const std::size_t stride = 1 + (indices.size() - 1) / kMaxPoints;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const std::size_t i = indices[k];
    sum += cloud.points[i].cast<double>();
    if (k % stride == 0) object.points.emplace_back(cloud.points[i].cast<double>());
    if (cloud.colors.empty()) continue;
    color += Eigen::Vector3f(cloud.colors[i].r, cloud.colors[i].g, cloud.colors[i].b);
  }
  object.centroid = sum / static_cast<double>(indices.size());
  object.color = color / static_cast<float>(indices.size());
  object.has_color = !cloud.colors.empty();
}

}  // namespace

std::vector<ObjectMeasurement> measure_objects(const LabeledCloud& cloud,
                                               const Transform<World, Sensor>& T_world_sensor) {
  const auto indices = members(cloud);
  std::vector<ObjectMeasurement::Cut> cuts(cloud.clusters.size());
  if (cloud.organised()) cuts = find_cuts(cloud);
  std::vector<ObjectMeasurement> objects;
  for (std::size_t c = 0; c < cloud.clusters.size(); ++c) {
    const DynamicCluster& cluster = cloud.clusters[c];
    const bool has_place =
        !indices[c].empty() || (cluster.box_min.allFinite() && cluster.box_max.allFinite());
    if (!has_place || is_secondary(cloud, c)) continue;
    ObjectMeasurement& object = objects.emplace_back();
    object.stamp = cloud.stamp;
    object.object_class = cloud.clusters[c].object_class;
    object.score = cloud.clusters[c].score;
    object.sensor = T_world_sensor.translation();
    object.right = T_world_sensor.rotation().col(0);
    object.cut = cuts[c];
    if (indices[c].empty()) {
      object.points = corners(cloud.clusters[c]);
      object.centroid = 0.5 * (object.points.front() + object.points.back());
    } else {
      measure_points(cloud, indices[c], object);
    }
    for (Eigen::Vector3d& point : object.points) point = T_world_sensor * point;
    object.centroid = T_world_sensor * object.centroid;
  }
  return objects;
}

}  // namespace mms
