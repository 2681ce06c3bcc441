#pragma once

#include <vector>

#include "mms/evaluation/segmentation/segmentation_scores.hpp"
#include "mms/io/image/coco_io.hpp"

namespace mms::test {

/// COCO's evaluation of all classes and images once more, written down as pycocotools has it: pixel
/// by pixel, array by array, with nothing left out or kept for later.
SegmentationScores naive_scores(const CocoDataset& truth, const std::vector<CocoResult>& results);

}  // namespace mms::test
