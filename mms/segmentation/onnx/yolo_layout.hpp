#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mms::onnx {

/// Lengths of a tensor's axes.
using Shape = std::vector<int>;

/// Generations of YOLO-seg outputs.
enum class YoloFormat {
  kV5,  ///< 1 x N x (box, objectness, classes, coefficients): YOLOv5
  kV8,  ///< 1 x (box, classes, coefficients) x N: YOLOv8, YOLO11
};

/// Layout of N predicted objects in a model's outputs: the predictions, and the prototypes (1 x
/// coefficients x mask_height x mask_width) of which masks are weighted sums.
struct YoloLayout {
  static constexpr int kBox = 4;  ///< center x, center y, width, height [px of the input]

  YoloFormat format = YoloFormat::kV8;
  std::size_t predictions = 0;  ///< index among the outputs
  std::size_t prototypes = 1;
  int objects = 0;  ///< N
  int classes = 0;
  int coefficients = 0;  ///< per mask
  int mask_width = 0;    ///< [px]
  int mask_height = 0;

  bool has_objectness() const { return format == YoloFormat::kV5; }
  int first_class() const { return has_objectness() ? kBox + 1 : kBox; }
  int first_coefficient() const { return first_class() + classes; }
  int channels() const { return first_coefficient() + coefficients; }

  /// Position of one value of an object in the predictions.
  std::size_t index(int object, int channel) const {
    const bool rows = format == YoloFormat::kV5;
    const auto row = static_cast<std::size_t>(rows ? object : channel);
    const auto column = static_cast<std::size_t>(rows ? channel : object);
    return row * static_cast<std::size_t>(rows ? channels() : objects) + column;
  }
};

/// Determines the layout from the shapes of a model's outputs, in any order.
/// @param classes  number of classes
/// @throws DataError at `where` with the found and the supported shapes.
YoloLayout find_layout(const std::vector<Shape>& outputs, int classes, const std::string& where);

}  // namespace mms::onnx
