#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mms/evaluation/segmentation/segmentation_scores.hpp"
#include "mms/io/image/coco_io.hpp"

namespace mms {

/// Ground truth and results of one class in one image. References its arguments.
struct ClassInImage {
  std::vector<const CocoAnnotation*> truth;
  std::vector<const CocoResult*> results;
};

/// One class in all images that contain it, by image id.
using ClassInImages = std::map<std::int64_t, ClassInImage>;

/// The twelve COCO numbers of one class; all NaN if the ground truth has none of it. Masks of one
/// image must have equal size; scores must be numbers.
SegmentationScores class_scores(const ClassInImages& images);

}  // namespace mms
