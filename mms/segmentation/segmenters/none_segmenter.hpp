#pragma once

#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

/// Segmenter that finds nothing: the paper's row without semantic information.
class NoneSegmenter : public Segmenter {
 public:
  Segmentation segment(const Frame& frame) override;
};

}  // namespace mms
