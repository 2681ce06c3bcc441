#include "mms/segmentation/onnx/yolo_layout.hpp"

#include <algorithm>

#include "mms/core/error.hpp"

namespace mms::onnx {
namespace {

std::string text_of(const Shape& shape) {
  std::string text;
  for (const int length : shape) text += (text.empty() ? "" : ", ") + std::to_string(length);
  return "(" + text + ")";
}

[[noreturn]] void fail(const std::vector<Shape>& outputs, int classes, const std::string& where) {
  std::string found;
  for (const Shape& shape : outputs) found += (found.empty() ? "" : " and ") + text_of(shape);
  const std::string count = std::to_string(classes);
  throw DataError(
      where,
      "gives " + (found.empty() ? "nothing" : found) + ", supported for " + count +
          " classes: (1, 4 + " + count +
          " + M, N) of YOLOv8-seg and YOLO11-seg "
          "and (1, N, 5 + " +
          count + " + M) of YOLOv5-seg, each with (1, M, H, W)",
      "use a model for segmentation, exported without NMS, and give its class names in order");
}

bool is_of_one_picture(const Shape& shape, std::size_t axes) {
  return shape.size() == axes && shape[0] == 1 &&
         std::all_of(shape.begin(), shape.end(), [](int length) { return length > 0; });
}

}  // namespace

YoloLayout find_layout(const std::vector<Shape>& outputs, int classes, const std::string& where) {
  if (outputs.size() != 2) fail(outputs, classes, where);
  YoloLayout layout;
  layout.predictions = outputs[0].size() == 3 ? 0 : 1;
  layout.prototypes = 1 - layout.predictions;
  const Shape& predictions = outputs[layout.predictions];
  const Shape& prototypes = outputs[layout.prototypes];
  if (!is_of_one_picture(predictions, 3) || !is_of_one_picture(prototypes, 4)) {
    fail(outputs, classes, where);
  }
  layout.classes = classes;
  layout.coefficients = prototypes[1];
  layout.mask_height = prototypes[2];
  layout.mask_width = prototypes[3];
  // A network proposes about as many objects as there are mask pixels. Models that suppress
  // duplicates themselves give a few, in rows of box, score, class number and mask: for one class
  // as many values as YOLOv5's.
  const bool few = 4LL * predictions[1] < 1LL * layout.mask_width * layout.mask_height;
  if (predictions[2] == 6 + layout.coefficients && few) {
    throw DataError(where,
                    "gives " + text_of(predictions) +
                        ": objects after its own suppression of "
                        "duplicates, as YOLO26 does",
                    "export it again with end2end=False nms=False");
  }
  layout.objects = predictions[2];
  if (predictions[1] == layout.channels()) return layout;
  layout.format = YoloFormat::kV5;
  layout.objects = predictions[1];
  if (predictions[2] == layout.channels()) return layout;
  fail(outputs, classes, where);
}

}  // namespace mms::onnx
