#pragma once

#include <cstdint>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/segmentation.hpp"

namespace mms {

/// The vision-only fusion: a point is dynamic where a mask covers it, and every instance with
/// points is one cluster.
/// @param covering  of every point: 0 or 1 + index of the instance over it
void label_by_mask(const std::vector<std::uint16_t>& covering,
                   const std::vector<Instance>& instances, LabeledCloud& cloud);

}  // namespace mms
