#pragma once

#include <string>

#include "mms/core/config_visitor.hpp"

namespace mms {

/// Inference settings of ONNX models. The defaults are those of YOLO tools.
struct OnnxConfig {
  int input_side = 640;   ///< of the square input, if the model does not specify it [px]
  double score = 0.25;    ///< of an object, exclusive
  double overlap = 0.45;  ///< largest intersection over union of two boxes of one class
  int instances = 100;    ///< largest number after non-maximum suppression
  std::string classes{};  ///< comma-separated names; empty: those of the file, else COCO's 80

  /// Inline, so that a config of another module can contain this one without OpenCV.
  void visit(ConfigVisitor& v) {
    v.integer({"input_side", "px", "side of the input if the model does not specify it"},
              input_side, {32, 4096});
    v.number({"score", "", "smallest score of an object, exclusive"}, score, {0.0, 1.0});
    v.number({"overlap", "", "largest overlap (IoU) of two boxes of one class"}, overlap,
             {0.0, 1.0});
    v.integer({"instances", "", "largest number per image"}, instances, {1, 1000});
    v.text({"classes", "", "class names, as in person,car; none: those of the file"}, classes);
  }
};

}  // namespace mms
