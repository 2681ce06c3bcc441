#pragma once

#include <cstdint>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/segmentation.hpp"
#include "mms/fusion/config/fusion_config.hpp"

namespace mms {

/// What the points under a mask say of it.
enum class Plausibility : std::uint8_t { kPlausible, kDoubtful, kImpossible };

/// Judges masks by their points in 3D. Impossible are, unless they have few returns, masks
/// - larger along two axes than 1.2 times the length of the class;
/// - of a person: a flat surface larger than a body, as a wall, a table or a monitor.
/// Doubtful are masks near these limits, those of flat surfaces too far to be sure, and those with
/// few returns for their size.
/// @param cloud     static
/// @param covering  of every point: 0 or 1 + index of the instance over it
/// @returns one for each instance
std::vector<Plausibility> judge_masks(const LabeledCloud& cloud,
                                      const std::vector<std::uint16_t>& covering,
                                      const std::vector<Instance>& instances,
                                      const FusionConfig& config);

}  // namespace mms
