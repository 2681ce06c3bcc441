#pragma once

#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

/// Takes the instances from the label image a recording brings along (`Frame::mask`: 0 static, else
/// 1 + class id). Every 8-connected component of one value is an instance with score 1, whatever
/// its size; instances come in the row-major order of their first pixel. Values above the known
/// classes (masks of other tools often have 255) say only that something is dynamic and become
/// persons. A frame without a mask has no instances.
class MaskSegmenter : public Segmenter {
 public:
  Segmentation segment(const Frame& frame) override;
};

}  // namespace mms
