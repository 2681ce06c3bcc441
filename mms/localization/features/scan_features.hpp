#pragma once

#include "mms/core/labeled_cloud.hpp"
#include "mms/localization/features/feature_cloud.hpp"
#include "mms/localization/features/feature_extractor.hpp"

namespace mms {

/// Adds the edge and planar features of an unorganised scan (spinning or solid-state LiDAR) to
/// `features`. Nothing is assumed about rings or scan order: neighborhoods are radius searches.
void extract_scan_features(const LabeledCloud& cloud, const FeatureConfig& config,
                           FeatureCloud& features);

}  // namespace mms
