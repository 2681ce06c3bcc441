#pragma once

#include <vector>

#include "mms/segmentation/solo/solo_decoder.hpp"

namespace mms {

/// A mask of the network at the size of the image: bilinear interpolation of the probabilities,
/// object where they exceed one half, cropped. Without category and score; empty if there is no
/// such pixel.
/// @param soft        probabilities at a quarter of the input's size, rows of mask_width
Detection upsampled_mask(const std::vector<float>& soft, int mask_width,
                         const PreparedImage& prepared);

}  // namespace mms
