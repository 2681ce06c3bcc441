#pragma once

#include <string>
#include <vector>

#include "mms/evaluation/segmentation/segmentation_scores.hpp"
#include "mms/io/image/coco_io.hpp"

namespace mms {

struct SegmentationErrorOptions {
  std::string category{};                ///< the one class to evaluate; empty: all of the truth
  std::string split{};                   ///< the images to evaluate; empty: all of the truth
  std::string truth_name = "truth";      ///< what errors call the truth, as the file's name
  std::string results_name = "results";  ///< what errors call the results
};

/// COCO's mask evaluation, the numbers of pycocotools' COCOeval (iouType "segm"): overlaps of
/// full-size masks, at most 100 results an image and class, objects that are crowds or of another
/// size ignored. Results of classes that are not evaluated are passed over, and of images of
/// another split. Results of equal score count in the order of their images' ids, then of the list.
/// (One difference: pycocotools takes a hit on the annotation of id 0 for a miss; here ids have no
/// meaning.)
/// @throws DataError for a category or split that the truth does not have, a result of an unknown
///         image, with a mask of another size than its image, or with a score that is no number.
SegmentationErrors segmentation_error(const CocoDataset& truth,
                                      const std::vector<CocoResult>& results,
                                      const SegmentationErrorOptions& options = {});

}  // namespace mms
