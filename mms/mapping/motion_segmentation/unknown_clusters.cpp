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
  DynamicCluster& whole = cloud.clusters[static_cast<std::size_t>(cluster)];
  ++whole.points;
  whole.centroid += (position - whole.centroid) / static_cast<float>(whole.points);
  whole.box_min = whole.box_min.cwiseMin(position);
  whole.box_max = whole.box_max.cwiseMax(position);
}

}  // namespace mms
