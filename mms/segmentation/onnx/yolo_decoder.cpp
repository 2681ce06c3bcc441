#include "mms/segmentation/onnx/yolo_decoder.hpp"

#include "mms/segmentation/onnx/yolo_boxes.hpp"
#include "mms/segmentation/onnx/yolo_mask.hpp"

namespace mms::onnx {
namespace {

std::vector<float> coefficients_of(const YoloBox& box, const float* predictions,
                                   const YoloLayout& layout) {
  std::vector<float> coefficients;
  for (int channel = layout.first_coefficient(); channel < layout.channels(); ++channel) {
    coefficients.push_back(predictions[layout.index(box.object, channel)]);
  }
  return coefficients;
}

}  // namespace

std::vector<Detection> decode_yolo(const YoloOutputs& outputs, const YoloLayout& layout,
                                   const Letterbox& letterbox, const OnnxConfig& config) {
  const std::vector<YoloBox> boxes =
      suppress_boxes(likely_boxes(outputs.predictions, layout, static_cast<float>(config.score)),
                     static_cast<float>(config.overlap), config.instances);
  const Prototypes prototypes{outputs.prototypes, layout.mask_width, layout.mask_height};
  std::vector<Detection> detections;
  for (const YoloBox& box : boxes) {
    Detection detection =
        mask_in_box(box, coefficients_of(box, outputs.predictions, layout), prototypes, letterbox);
    if (!detection.mask.empty()) detections.push_back(std::move(detection));
  }
  return detections;
}

}  // namespace mms::onnx
