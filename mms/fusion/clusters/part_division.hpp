#pragma once

#include <vector>

#include "mms/fusion/clouds/nodes.hpp"
#include "mms/fusion/clusters/dynamic_parts.hpp"
#include "mms/fusion/config/fusion_config.hpp"

namespace mms {

/// Divides a dynamic part that several masks cover (people who touch, or stand closer than the
/// cluster tolerance) into one part an instance: masked nodes go with their mask, the others with
/// the instance whose center is nearest. Masks with a small share of the part, or at the same
/// position on the floor as a larger one (two halves of one body), do not count. Boxes are empty.
/// @return the part itself if one mask or none counts
std::vector<DynamicPart> divide_part(const Nodes& nodes, DynamicPart part,
                                     const FusionConfig& config);

}  // namespace mms
