#pragma once

#include <Eigen/Core>

#include "mms/core/labeled_cloud.hpp"

namespace mms {

/// Adds a cluster of unknown class without points. @returns its index
int add_unknown_cluster(LabeledCloud& cloud);

/// Makes a static point dynamic and adds it to a cluster: its count, centroid and box.
void make_dynamic(std::size_t point, int cluster, LabeledCloud& cloud);

}  // namespace mms
