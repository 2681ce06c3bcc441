#pragma once

#include "mms/core/frame.hpp"
#include "mms/core/segmentation.hpp"

namespace mms {

/// Segments the potentially dynamic objects in a frame's image (III-A).
class Segmenter {
 public:
  virtual ~Segmenter() = default;

  /// The instances of `frame`; the result has the size of the segmented image.
  virtual Segmentation segment(const Frame& frame) = 0;
};

/// Segmenter without instances: the paper's row without semantic information.
class NoneSegmenter : public Segmenter {
 public:
  Segmentation segment(const Frame& frame) override {
    return {frame.color.width(), frame.color.height(), {}};
  }
};

}  // namespace mms
