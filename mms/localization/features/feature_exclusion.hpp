#pragma once

#include <cstdint>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/localization/features/feature_cloud.hpp"

namespace mms {

/// Removes the edges and planes of `features` at non-zero `points`. Organised clouds: also the
/// depth of the intensity pyramid there and beside them.
/// @param points  width x height of `cloud`, from which the features were extracted
void exclude(const Image<std::uint8_t>& points, const LabeledCloud& cloud, FeatureCloud& features);

}  // namespace mms
