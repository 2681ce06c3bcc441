#pragma once

#include "mms/segmentation/segmenter.hpp"

namespace mms {

/// Segmenter that finds nothing: the paper's row without semantic information.
class NoneSegmenter : public Segmenter {
 public:
  Segmentation segment(const Frame& frame) override;
};

}  // namespace mms
