#pragma once

#include <Eigen/Core>

#include "mms/core/labeled_cloud.hpp"

namespace mms {

/// Index of a new cluster without points, of something that no mask named.
int add_unknown_cluster(LabeledCloud& cloud);

/// Makes a static point dynamic, as a part of a cluster.
void make_dynamic(std::size_t point, int cluster, LabeledCloud& cloud);

}  // namespace mms
