#pragma once

#include "mms/localization/features/feature_cloud.hpp"
#include "mms/localization/odometry.hpp"

namespace mms {

/// Whether features fit clearly better at one pose than at another one: by their photometric
/// residuals, without images by their number.
bool fits_better(const Odometry::Fit& fit, const Odometry::Fit& other);

/// Whether the features beside the masks say that the masks are right: that many of them fit at the
/// pose that follows the masks, and clearly worse at the pose that ignores them.
/// @param beside     the features
/// @param following  their fit at the pose that follows the masks
/// @param ignoring   their fit at the other pose
bool support_masks(const FeatureCloud& beside, const Odometry::Fit& following,
                   const Odometry::Fit& ignoring);

/// Whether nearly all of many features and pixels fit, by which the pose is right even if no
/// vehicle or person could move so: the pose before has an error.
/// @param alignment  of a frame, with more points than `other`
bool explains_more(const Odometry::Alignment& alignment, const Odometry::Alignment& other);

}  // namespace mms
