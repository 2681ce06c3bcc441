#pragma once

#include <vector>

#include "mms/segmentation/solo/solo_decoder.hpp"

namespace mms {

/// A mask of the network at the size of the picture: bilinear between the probabilities, object
/// where they exceed one half, cropped. Without category and score; an empty mask when nothing
/// does.
/// @param soft        probabilities at a quarter of the input's size, rows of mask_width
Detection upsampled_mask(const std::vector<float>& soft, int mask_width,
                         const PreparedImage& prepared);

}  // namespace mms
