#pragma once

#include <opencv2/dnn/dnn.hpp>

namespace mms::onnx {

/// Corrects where a network multiplies by constants. ONNX lines the axes of two tensors up at their
/// ends; OpenCV 4.6 always starts at axis 1, so that YOLOv8's (1, 4, N) times (1, N) cannot run.
/// Layers whose constants fit where they are stay as they are; newer OpenCV has none to correct.
/// @param input  1 x 3 x height x width
/// @throws cv::Exception when the layers do not fit together.
void repair_scales(cv::dnn::Net& network, const cv::dnn::MatShape& input);

}  // namespace mms::onnx
