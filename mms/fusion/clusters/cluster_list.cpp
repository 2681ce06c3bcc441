#include "mms/fusion/clusters/cluster_list.hpp"

#include <cstddef>

namespace mms {

void list_clusters(const std::vector<DynamicObjects::Object>& objects,
                   const std::vector<Instance>& instances, LabeledCloud& cloud) {
  cloud.clusters.clear();
  for (const auto& object : objects) {
    const Instance& instance = instances[static_cast<std::size_t>(object.instance)];
    DynamicCluster cluster;
    cluster.object_class = instance.object_class;
    cluster.instance = object.instance;
    cluster.score = instance.score;
    cluster.box_min = object.box.min();
    cluster.box_max = object.box.max();
    cloud.clusters.push_back(cluster);
  }
  std::vector<Eigen::Vector3d> sums(objects.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.cluster[i] < 0) continue;
    const auto c = static_cast<std::size_t>(cloud.cluster[i]);
    sums[c] += cloud.points[i].cast<double>();
    ++cloud.clusters[c].points;
  }
  for (std::size_t c = 0; c < sums.size(); ++c) {
    const int points = cloud.clusters[c].points;
    if (points > 0) cloud.clusters[c].centroid = (sums[c] / points).cast<float>();
  }
}

}  // namespace mms
