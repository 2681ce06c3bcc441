#pragma once

#include <vector>

#include "mms/segmentation/onnx/letterbox.hpp"
#include "mms/segmentation/onnx/yolo_boxes.hpp"
#include "mms/segmentation/solo/solo_decoder.hpp"

namespace mms::onnx {

/// Prototypes: every object's mask is a weighted sum of them.
struct Prototypes {
  const float* values = nullptr;  ///< count x height x width, over the whole input of the network
  int width = 0;                  ///< [px]
  int height = 0;
};

/// Mask of a box at the size of the image: sigmoid of the weighted sum of the prototypes, bilinear
/// between their pixels, object where it exceeds one half and the pixel's center is in the box;
/// cropped. Empty if there is none.
/// @param coefficients  one weight per prototype
Detection mask_in_box(const YoloBox& box, const std::vector<float>& coefficients,
                      const Prototypes& prototypes, const Letterbox& letterbox);

}  // namespace mms::onnx
