#include "mms/mapping/observations.hpp"

#include <Eigen/Geometry>

namespace mms {
namespace {

/// World boxes of the clusters' points; empty ones for clusters without points.
std::vector<Eigen::AlignedBox3d> boxes_of_points(const LabeledCloud& cloud,
                                                 const Transform<World, Sensor>& T_world_sensor) {
  std::vector<Eigen::AlignedBox3d> boxes(cloud.clusters.size());
  for (std::size_t i = 0; i < cloud.cluster.size(); ++i) {
    const int c = cloud.cluster[i];
    if (c < 0 || !cloud.points[i].allFinite()) continue;
    boxes[static_cast<std::size_t>(c)].extend(T_world_sensor * cloud.points[i].cast<double>());
  }
  return boxes;
}

Eigen::AlignedBox3d box_of_corners(const DynamicCluster& cluster,
                                   const Transform<World, Sensor>& T_world_sensor) {
  const Eigen::AlignedBox3f box(cluster.box_min, cluster.box_max);
  return box.cast<double>().transformed(T_world_sensor.isometry());
}

}  // namespace

std::vector<ObjectObservation> observe_objects(const LabeledCloud& cloud,
                                               const Transform<World, Sensor>& T_world_sensor) {
  std::vector<Eigen::AlignedBox3d> boxes = boxes_of_points(cloud, T_world_sensor);
  std::vector<ObjectObservation> objects;
  for (std::size_t i = 0; i < cloud.clusters.size(); ++i) {
    const DynamicCluster& cluster = cloud.clusters[i];
    if (boxes[i].isEmpty()) boxes[i] = box_of_corners(cluster, T_world_sensor);
    ObjectObservation object;
    object.stamp = cloud.stamp;
    object.object_class = cluster.object_class;
    object.score = cluster.score;
    object.centroid = T_world_sensor * cluster.centroid.cast<double>();
    object.box_min = boxes[i].min();
    object.box_max = boxes[i].max();
    objects.push_back(object);
  }
  return objects;
}

}  // namespace mms
