#pragma once

#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

/// Takes the instances from the recorded label image (`Frame::mask`: 0 static, else 1 + class id).
/// Every 8-connected component of one value is an instance with score 1; instances are in row-major
/// order of their first pixel. Values above the known classes (masks of other tools often have 255)
/// become persons. A frame without a mask has no instances.
class MaskSegmenter : public Segmenter {
 public:
  Segmentation segment(const Frame& frame) override;
};

}  // namespace mms
