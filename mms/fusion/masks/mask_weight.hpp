#pragma once

#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/fusion/masks/mask_plausibility.hpp"

namespace mms {

/// Sets the weights of the cloud's clusters: masks that are doubtful by their points count less,
/// and those that were not followed for a second in a blurred image.
/// @param judged  by instance; none for instances beyond them
void weigh_masks(const std::vector<Plausibility>& judged, LabeledCloud& cloud);

/// Lowers the weights of masks that were not followed for a second while the sensor turns fast.
/// @param turn_rate  [rad/s]
void weigh_masks_in_turn(double turn_rate, LabeledCloud& cloud);

}  // namespace mms
