#include "mms/fusion/dynamic_objects.hpp"

#include <algorithm>
#include <cstddef>

#include "mms/fusion/dynamic_parts.hpp"

namespace mms {

DynamicObjects find_dynamic_objects(const Nodes& nodes, const std::vector<Instance>& instances,
                                    const FusionConfig& config) {
  auto [parts, loose] = find_dynamic_parts(nodes, instances, config);
  std::stable_sort(parts.begin(), parts.end(), [](const DynamicPart& a, const DynamicPart& b) {
    return a.nodes.size() > b.nodes.size();
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
          return other.instance == part.instance && fits(other.box.merged(part.box), size);
        });
    if (object == result.objects.end()) {
      object = result.objects.insert(object, {part.instance, part.box});
    }
    object->box.extend(part.box);
    const int index = static_cast<int>(object - result.objects.begin());
    for (const std::size_t i : part.nodes) result.label[i] = index;
  }
  return result;
}

}  // namespace mms
