#pragma once

#include <vector>

#include "mms/segmentation/onnx/letterbox.hpp"
#include "mms/segmentation/onnx/onnx_config.hpp"
#include "mms/segmentation/onnx/yolo_layout.hpp"
#include "mms/segmentation/solo/solo_decoder.hpp"

namespace mms::onnx {

/// Outputs of a YOLO-seg model for one image, contiguous float32.
struct YoloOutputs {
  const float* predictions = nullptr;  ///< see the layout
  const float* prototypes = nullptr;   ///< coefficients x mask_height x mask_width
};

/// Decodes the outputs into objects (threshold, non-maximum suppression per class, masks cropped by
/// their boxes), highest score first, with masks at the size of the image. Objects without a pixel
/// in the image are ignored.
std::vector<Detection> decode_yolo(const YoloOutputs& outputs, const YoloLayout& layout,
                                   const Letterbox& letterbox, const OnnxConfig& config);

}  // namespace mms::onnx
