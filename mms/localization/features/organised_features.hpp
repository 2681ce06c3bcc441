#pragma once

#include "mms/core/labeled_cloud.hpp"
#include "mms/localization/features/feature_cloud.hpp"
#include "mms/localization/features/feature_extractor.hpp"

namespace mms {

/// Adds the edge and planar features of an organised cloud to `features`.
void extract_organised_features(const LabeledCloud& cloud, const FeatureConfig& config,
                                FeatureCloud& features);

}  // namespace mms
