#pragma once

#include <vector>

#include "mms/segmentation/onnx/yolo_layout.hpp"

namespace mms::onnx {

/// A box that the network proposes. Its sides are places in the input [px].
struct YoloBox {
  int object = 0;    ///< among the predictions
  int category = 0;  ///< the likeliest class
  float score = 0.0F;
  float left = 0.0F;
  float top = 0.0F;
  float right = 0.0F;
  float bottom = 0.0F;
};

/// The boxes whose score is above `least`: the probability of their likeliest class, times the
/// objectness where the layout has one. Boxes without an area are left out.
/// @param predictions  float32, contiguous, as `layout` says
std::vector<YoloBox> likely_boxes(const float* predictions, const YoloLayout& layout, float least);

/// Non-maximum suppression class by class: best first, without those whose intersection over union
/// with a better one of their class is above `overlap`; at most `most`.
std::vector<YoloBox> suppress_boxes(std::vector<YoloBox> boxes, float overlap, int most);

}  // namespace mms::onnx
