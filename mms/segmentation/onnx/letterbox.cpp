#include "mms/segmentation/onnx/letterbox.hpp"

#include <algorithm>

#include "mms/segmentation/solo/resize.hpp"

namespace mms::onnx {
namespace {

LetterboxAxis fit_axis(int image, int input, double scale) {
  const int scaled = std::min(input, scaled_length(image, scale));
  return {image, input, scaled, (input - scaled) / 2};
}

}  // namespace

Letterbox fit_letterbox(int image_width, int image_height, int input_width, int input_height) {
  const double scale = std::min(static_cast<double>(input_width) / image_width,
                                static_cast<double>(input_height) / image_height);
  return {fit_axis(image_width, input_width, scale), fit_axis(image_height, input_height, scale)};
}

}  // namespace mms::onnx
