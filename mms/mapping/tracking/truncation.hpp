#pragma once

#include <vector>

#include "mms/mapping/tracking/group_division.hpp"
#include "mms/mapping/tracking/object_measurement.hpp"

namespace mms {

/// Sides at which the parts of an organised cloud's clusters are truncated: a quarter of the side's
/// boundary lies at the image's border or beside a nearer surface.
/// @return one for each part
std::vector<ObjectMeasurement::Truncation> find_truncations(const LabeledCloud& cloud,
                                                            const ClusterParts& parts);

}  // namespace mms
