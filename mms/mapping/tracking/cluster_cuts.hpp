#pragma once

#include <vector>

#include "mms/mapping/tracking/group_division.hpp"
#include "mms/mapping/tracking/object_measurement.hpp"

namespace mms {

/// Looks along the rims of the parts of an organised cloud's clusters for what cuts them off: the
/// image's border or a nearer surface beside them. A side is cut where that holds for a good part
/// of its rim.
/// @return one for each part
std::vector<ObjectMeasurement::Cut> find_cuts(const LabeledCloud& cloud, const ClusterParts& parts);

}  // namespace mms
