#pragma once

#include <cstdint>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/localization/features/feature_cloud.hpp"

namespace mms {

/// Intensity pyramid of an organised, coloured cloud, finest level (the cloud's grid) first. Each
/// level halves the one before; it ends early when a level would be under 16 pixels wide or high.
std::vector<IntensityLevel> build_intensity_pyramid(const LabeledCloud& cloud, int levels);

/// Removes, in all levels, the depth of the pixels whose color or gradient includes a dynamic
/// pixel.
/// @param dynamic  non-zero at dynamic pixels, of the finest level's size
void keep_clear(Image<std::uint8_t> dynamic, std::vector<IntensityLevel>& pyramid);

}  // namespace mms
