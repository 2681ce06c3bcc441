#pragma once

#include <vector>

#include "mms/segmentation/onnx/letterbox.hpp"
#include "mms/segmentation/onnx/onnx_config.hpp"
#include "mms/segmentation/onnx/yolo_layout.hpp"
#include "mms/segmentation/solo/solo_decoder.hpp"

namespace mms::onnx {

/// A YOLO-seg model's outputs for one picture, contiguous float32.
struct YoloOutputs {
  const float* predictions = nullptr;  ///< as the layout says
  const float* prototypes = nullptr;   ///< coefficients x mask_height x mask_width
};

/// Turns the outputs into objects (threshold, non-maximum suppression class by class, masks cut out
/// by their boxes), best first, with masks at the size of the picture. Objects without a pixel in
/// the picture are left out.
std::vector<Detection> decode_yolo(const YoloOutputs& outputs, const YoloLayout& layout,
                                   const Letterbox& letterbox, const OnnxConfig& config);

}  // namespace mms::onnx
