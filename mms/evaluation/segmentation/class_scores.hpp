#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mms/evaluation/segmentation/segmentation_scores.hpp"
#include "mms/io/image/coco_io.hpp"

namespace mms {

/// What is there of one class in one image: in truth, and as found. Views what it points to.
struct ClassInImage {
  std::vector<const CocoAnnotation*> truth;
  std::vector<const CocoResult*> results;
};

/// One class in all images that have any of it, by the images' ids.
using ClassInImages = std::map<std::int64_t, ClassInImage>;

/// The twelve numbers of one class; all NaN where the truth has none of it. Masks of one image have
/// to be of one size, scores numbers.
SegmentationScores class_scores(const ClassInImages& images);

}  // namespace mms
