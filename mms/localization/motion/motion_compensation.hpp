#pragma once

#include "mms/core/labeled_cloud.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/localization/features/feature_cloud.hpp"

namespace mms {

/// The features as they would have been measured at `stamp` by a sensor that moves with `velocity`
/// (in its own frame [m/s, rad/s]): cameras take depth and colour a few milliseconds apart.
/// @param elapsed  since the previous frame [s]
FeatureCloud at_stamp(FeatureCloud features, const Vector6d& velocity, double elapsed);

/// The features of a scan as if all were measured at the center of its time.
void deskew(FeatureCloud& features, const Vector6d& velocity);

/// The points of a scan as if all were measured at its stamp. Clouds without `time_offset` do not
/// change.
void deskew(LabeledCloud& cloud, const Vector6d& velocity);

}  // namespace mms
