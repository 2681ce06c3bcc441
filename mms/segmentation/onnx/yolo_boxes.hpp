#pragma once

#include <vector>

#include "mms/segmentation/onnx/yolo_layout.hpp"

namespace mms::onnx {

/// A box predicted by the network. Its sides are positions in the input [px].
struct YoloBox {
  int object = 0;    ///< index among the predictions
  int category = 0;  ///< the most probable class
  float score = 0.0F;
  float left = 0.0F;
  float top = 0.0F;
  float right = 0.0F;
  float bottom = 0.0F;
};

/// The boxes with a score above `least`: the probability of their most probable class, times the
/// objectness if the layout has one. Boxes without area are ignored.
/// @param predictions  float32, contiguous, with `layout`
std::vector<YoloBox> likely_boxes(const float* predictions, const YoloLayout& layout, float least);

/// Non-maximum suppression per class: highest score first, without boxes whose intersection over
/// union with a better one is above `overlap`; at most `most`.
std::vector<YoloBox> suppress_boxes(std::vector<YoloBox> boxes, float overlap, int most);

}  // namespace mms::onnx
