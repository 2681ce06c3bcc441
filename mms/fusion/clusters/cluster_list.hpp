#pragma once

#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/segmentation.hpp"
#include "mms/fusion/clusters/dynamic_objects.hpp"

namespace mms {

/// Fills `cloud.clusters` with the objects, counted and averaged over the cloud's points.
void list_clusters(const std::vector<DynamicObjects::Object>& objects,
                   const std::vector<Instance>& instances, LabeledCloud& cloud);

}  // namespace mms
