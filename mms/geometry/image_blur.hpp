#pragma once

#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// How blurred an image is, from 0 (sharp) to 1, along the worse of its two axes: the share of the
/// differences between neighbors that another blur leaves (Crété et al., The blur effect, SPIE
/// 2007). 0 without any difference.
/// @param colors  width x height, row-major
double image_blur(const std::vector<Rgb>& colors, int width, int height);

}  // namespace mms
