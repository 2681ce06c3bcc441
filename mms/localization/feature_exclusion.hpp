#pragma once

#include <cstdint>

#include "mms/core/feature_cloud.hpp"
#include "mms/core/image.hpp"

namespace mms {

/// Takes out of `features` what lies on non-zero `pixels` or beside them: edges and planes, and the
/// depth of the intensity pyramid.
/// @param camera  of the image `pixels`, in which the features' points were measured
void exclude(const Image<std::uint8_t>& pixels, const CameraIntrinsics& camera,
             FeatureCloud& features);

}  // namespace mms
