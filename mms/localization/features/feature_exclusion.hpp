#pragma once

#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/localization/features/feature_cloud.hpp"

namespace mms {

/// Takes out of `features` what lies on non-zero `pixels` or beside them: edges and planes, and the
/// depth of the intensity pyramid.
/// @param camera  of the image `pixels`, in which the features' points were measured
void exclude(const Image<std::uint8_t>& pixels, const CameraIntrinsics& camera,
             FeatureCloud& features);

/// Takes the edges and planes of a scan out whose points are not static.
/// @param labels  of the scan's points
void exclude_dynamic(const std::vector<PointLabel>& labels, FeatureCloud& features);

}  // namespace mms
