#pragma once

#include <cstdint>

#include "mms/core/image.hpp"
#include "mms/core/segmentation.hpp"

namespace mms {

/// All instance masks of a frame in one image (III-A), on blocks of image pixels. A value is 0 for
/// the static state, else 1 + the index of the instance; where instances overlap the one with the
/// higher score (the earlier, for equal scores) counts.
struct MaskImage {
  Image<std::uint16_t> raw;      ///< the masks as segmented
  Image<std::uint16_t> dilated;  ///< grown by morphological dilation (III-B.1)
  int radius = 0;                ///< of the dilation [blocks]
};

/// Whether masks of the image were computed: not in a segmentation of size 0 x 0.
inline bool is_computed(const Segmentation& segmentation) {
  return segmentation.width > 0 || segmentation.height > 0 || !segmentation.instances.empty();
}

/// Draws `segmentation` on blocks of stride x stride pixels; a block is dynamic when any of its
/// pixels is. One that was not computed gives an empty mask of the size asked for.
/// @param width, height  of the image [px]
/// @param dilation       radius [share of the image width]
/// @throws DataError when the segmentation is of another size than the image
MaskImage make_mask_image(const Segmentation& segmentation, int width, int height, int stride,
                          double dilation);

/// Dilates the non-zero pixels by a disc of `radius` pixels.
void dilate(Image<std::uint8_t>& image, int radius);

}  // namespace mms
