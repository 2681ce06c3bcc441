#pragma once

#include <string>

#include "mms/core/config.hpp"

namespace mms {

/// How an ONNX model is run and which of its objects are kept. The defaults are those of YOLO's
/// own tools.
struct OnnxConfig {
  int input_side = 640;      ///< of the square input, where the model leaves it open [px]
  double score = 0.25;       ///< an object's has to be above it
  double overlap = 0.45;     ///< largest intersection over union of two boxes of one class
  int instances = 100;       ///< at most, after non-maximum suppression
  std::string classes = "";  ///< names with commas between; empty: the file's own, else COCO's 80

  /// Inline, so that a config of another module can hold this one without OpenCV.
  void visit(ConfigVisitor& v) {
    v.integer({"input_side", "px", "side of the input where the model leaves it open"}, input_side,
              {32, 4096});
    v.number({"score", "", "an object's score has to be above it"}, score, {0.0, 1.0});
    v.number({"overlap", "", "largest overlap (IoU) of two boxes of one class"}, overlap,
             {0.0, 1.0});
    v.integer({"instances", "", "at most, in a picture"}, instances, {1, 1000});
    v.text({"classes", "", "the model's classes, as in person,car; none: as the file says"},
           classes);
  }
};

}  // namespace mms
