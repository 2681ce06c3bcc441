#pragma once

#include <cstdint>
#include <vector>

#include "mms/fusion/config/fusion_config.hpp"
#include "mms/geometry/plane_segmentation.hpp"

namespace mms {

/// The large planes among `samples` that are not the flat side of a masked object: of a plane's
/// samples at most the share `PlaneRemoval::max_masked_share` is under a mask.
/// @param masked  of every sample: non-zero under a mask as segmented
std::vector<Plane> find_static_planes(const std::vector<PlaneSample>& samples,
                                      const std::vector<std::uint8_t>& masked,
                                      const PlaneRemoval& config);

}  // namespace mms
