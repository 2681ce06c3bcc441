#pragma once

#include <string>

#include "mms/segmentation/onnx/yolo_layout.hpp"

namespace mms::testing {

/// A model that detects red (class 0) and blue (class 1) in images of 64x64. Each of its 8x8 cells
/// of 8x8 px proposes a box of 32x32 px around its center with the probability 0.9 times its mean
/// of red (blue) minus green, in YOLOv5 with objectness 0.5. The mask has the red or blue pixels,
/// at a quarter of the input's size.
struct TinyOnnx {
  onnx::YoloFormat format = onnx::YoloFormat::kV8;
  int batch = 1;
  int channels = 3;
  int side = 64;                           ///< of the input as stated in the file; 0: open
  std::string names = "{0: 'r', 1: 'b'}";  ///< in the metadata
  std::string last = "Identity";           ///< operator that gives the predictions
  bool prototypes = true;                  ///< whether there is a second output
};

/// The bytes of its ONNX file.
std::string tiny_onnx(const TinyOnnx& model);

}  // namespace mms::testing
