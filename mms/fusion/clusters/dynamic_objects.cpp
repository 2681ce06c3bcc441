#include "mms/fusion/clusters/dynamic_objects.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "mms/fusion/clusters/dynamic_parts.hpp"

namespace mms {
namespace {

/// Length of a box (sensor frame [m]) along a direction.
float length_along(const Eigen::AlignedBox3f& box, const Eigen::Vector3f& direction) {
  return direction.cwiseAbs().dot(box.sizes());
}

/// The larger side of a box across a direction.
float size_across(const Eigen::AlignedBox3f& box, const Eigen::Array3f& direction) {
  return (box.sizes().array() * (1.0F - direction.square()).max(0.0F).sqrt()).maxCoeff();
}

/// Whether two parts under one mask can belong to one object.
bool are_one(const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b, const ObjectSize& size) {
  const Eigen::AlignedBox3f both = a.merged(b);
  if (!fits(both, size)) return false;
  const Eigen::Vector3f sight = both.center().normalized();
  const float depths = 0.5F * (length_along(a, sight) + length_along(b, sight));
  const bool apart_in_depth = std::abs(sight.dot(b.center() - a.center())) > depths;
  const float most = static_cast<float>(size.depth) * size_across(both, sight.array());
  return !apart_in_depth || length_along(both, sight) <= most;
}

}  // namespace

DynamicObjects find_dynamic_objects(const Nodes& nodes, const std::vector<Instance>& instances,
                                    const FusionConfig& config) {
  auto [parts, loose] = find_dynamic_parts(nodes, instances, config);
  std::stable_sort(parts.begin(), parts.end(), [](const DynamicPart& a, const DynamicPart& b) {
    return std::pair(!a.is_sparse, a.nodes.size()) > std::pair(!b.is_sparse, b.nodes.size());
  });
  DynamicObjects result;
  result.label.assign(nodes.size(), DynamicObjects::kNone);
  result.loose.assign(nodes.size(), 0);
  for (const std::size_t i : loose) result.loose[i] = 1;
  for (const DynamicPart& part : parts) {
    const auto& instance = instances[static_cast<std::size_t>(part.instance)];
    const auto& size = config.sizes[static_cast<std::size_t>(instance.object_class)];
    auto object = std::find_if(
        result.objects.begin(), result.objects.end(), [&](const DynamicObjects::Object& other) {
          return other.instance == part.instance && are_one(other.box, part.box, size);
        });
    const bool has_other = std::any_of(
        result.objects.begin(), result.objects.end(),
        [&](const DynamicObjects::Object& other) { return other.instance == part.instance; });
    const bool is_new = object == result.objects.end();
    if (is_new && part.is_sparse && has_other) continue;  // background under the mask
    if (is_new) {
      object = result.objects.insert(object, {part.instance, part.box});
    }
    object->box.extend(part.box);
    const int index = static_cast<int>(object - result.objects.begin());
    for (const std::size_t i : part.nodes) result.label[i] = index;
  }
  return result;
}

}  // namespace mms
