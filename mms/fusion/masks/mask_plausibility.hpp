#pragma once

#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/segmentation.hpp"
#include "mms/fusion/clouds/mask_image.hpp"
#include "mms/fusion/config/fusion_config.hpp"

namespace mms {

/// Clears masks that cannot be what they claim, by their points in 3D:
/// - larger along two axes than 1.2 times the length of its class;
/// - of a person: a flat surface larger than a body, as a wall, a table or a monitor.
/// A mask with few returns is kept.
/// @param cloud      organized, static
/// @param instances  of the values of `mask`
/// @returns number of masks that were cleared
int clear_implausible_masks(const LabeledCloud& cloud, const std::vector<Instance>& instances,
                            const FusionConfig& config, MaskImage& mask);

}  // namespace mms
