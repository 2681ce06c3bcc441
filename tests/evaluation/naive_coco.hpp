#pragma once

#include <vector>

#include "mms/evaluation/segmentation/segmentation_scores.hpp"
#include "mms/io/image/coco_io.hpp"

namespace mms::test {

/// COCO's evaluation of all classes and images in the order of pycocotools, pixel by pixel, without
/// any optimization.
SegmentationScores naive_scores(const CocoDataset& truth, const std::vector<CocoResult>& results);

}  // namespace mms::test
