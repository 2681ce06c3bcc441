#include "mms/fusion/masks/mask_labels.hpp"

#include "mms/fusion/clusters/cluster_list.hpp"
#include "mms/geometry/trimmed_box.hpp"

namespace mms {
namespace {

/// [-]: share of the points cut off at either end of each axis of a box.
/// Source: initial choice; a mask dilated by 3 px around a person 80 px wide has 7 % of
/// background.
constexpr double kBoxTrim = 0.05;

}  // namespace

void label_by_mask(const std::vector<std::uint16_t>& covering,
                   const std::vector<Instance>& instances, LabeledCloud& cloud) {
  std::vector<std::vector<std::size_t>> members(instances.size());
  for (std::size_t i = 0; i < covering.size(); ++i) {
    if (covering[i] == 0 || cloud.labels[i] == PointLabel::kInvalid) continue;
    members[covering[i] - std::size_t{1}].push_back(i);
  }
  std::vector<DynamicObjects::Object> objects;
  for (std::size_t instance = 0; instance < members.size(); ++instance) {
    if (members[instance].empty()) continue;
    std::vector<Eigen::Vector3f> points;
    for (const std::size_t i : members[instance]) {
      points.push_back(cloud.points[i]);
      cloud.labels[i] = PointLabel::kDynamic;
      cloud.cluster[i] = static_cast<std::int16_t>(objects.size());
    }
    objects.push_back({static_cast<int>(instance), trimmed_box(points, kBoxTrim)});
  }
  list_clusters(objects, instances, cloud);
}

}  // namespace mms
