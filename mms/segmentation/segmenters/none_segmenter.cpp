#include "mms/segmentation/segmenters/none_segmenter.hpp"

namespace mms {

Segmentation NoneSegmenter::segment(const Frame& frame) {
  return {frame.color.width(), frame.color.height(), {}};
}

}  // namespace mms
