#pragma once

#include <vector>

#include "mms/mapping/tracking/group_division.hpp"
#include "mms/mapping/tracking/object_measurement.hpp"

namespace mms {

/// Looks along the boundaries of the parts of an organised cloud's clusters for what truncates
/// them: the image's border or a nearer surface beside them. A side is truncated where that holds
/// for a good part of its boundary.
/// @return one for each part
std::vector<ObjectMeasurement::Truncation> find_truncations(const LabeledCloud& cloud,
                                                            const ClusterParts& parts);

}  // namespace mms
