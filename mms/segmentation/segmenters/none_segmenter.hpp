#pragma once

#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

/// Segmenter without instances: the paper's row without semantic information.
class NoneSegmenter : public Segmenter {
 public:
  Segmentation segment(const Frame& frame) override;
};

}  // namespace mms
