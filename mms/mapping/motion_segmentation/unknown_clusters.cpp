#include "mms/mapping/motion_segmentation/unknown_clusters.hpp"

#include <limits>

namespace mms {

int add_unknown_cluster(LabeledCloud& cloud) {
  DynamicCluster cluster;
  cluster.object_class = ObjectClass::kUnknown;
  cluster.score = 0.0F;
  cluster.box_min.setConstant(std::numeric_limits<float>::infinity());
  cluster.box_max.setConstant(-std::numeric_limits<float>::infinity());
  cloud.clusters.push_back(cluster);
  return static_cast<int>(cloud.clusters.size()) - 1;
}

void make_dynamic(std::size_t point, int cluster, LabeledCloud& cloud) {
  cloud.labels[point] = PointLabel::kDynamic;
  cloud.cluster[point] = static_cast<std::int16_t>(cluster);
  const Eigen::Vector3f& position = cloud.points[point];
  DynamicCluster& to = cloud.clusters[static_cast<std::size_t>(cluster)];
  ++to.points;
  to.centroid += (position - to.centroid) / static_cast<float>(to.points);
  to.box_min = to.box_min.cwiseMin(position);
  to.box_max = to.box_max.cwiseMax(position);
}

}  // namespace mms
