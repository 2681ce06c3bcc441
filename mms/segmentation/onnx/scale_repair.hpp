#pragma once

#include <opencv2/dnn/dnn.hpp>

namespace mms::onnx {

/// Corrects multiplications by constants. ONNX aligns the axes of two tensors at their ends; OpenCV
/// 4.6 always starts at axis 1, so that YOLOv8's (1, 4, N) times (1, N) fails. Layers whose
/// constants fit are unchanged; newer OpenCV needs no correction.
/// @param input  1 x 3 x height x width
/// @throws cv::Exception if the layers do not fit together.
void repair_scales(cv::dnn::Net& network, const cv::dnn::MatShape& input);

}  // namespace mms::onnx
