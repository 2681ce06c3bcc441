#pragma once

#include "mms/core/labeled_cloud.hpp"
#include "mms/localization/features/feature_cloud.hpp"
#include "mms/localization/features/feature_extractor.hpp"

namespace mms {

/// Adds the edge and planar features of an unorganised scan (spinning or solid-state LiDAR) to
/// `features`. Nothing is assumed about rings or scan order: neighbourhoods are radius searches.
void extract_scan_features(const LabeledCloud& cloud, const FeatureConfig& config,
                           FeatureCloud& features);

/// Edge of the grid [m] a scan is thinned to when the configuration leaves the choice: a
/// twenty-fifth of the median range, so that rooms and streets get about as many points.
double automatic_scan_voxel(const std::vector<Eigen::Vector3f>& static_points);

}  // namespace mms
