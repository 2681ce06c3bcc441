#pragma once

#include <string>
#include <vector>

#include "mms/evaluation/segmentation/segmentation_scores.hpp"
#include "mms/io/image/coco_io.hpp"

namespace mms {

struct SegmentationErrorOptions {
  std::string category{};  ///< class to evaluate; empty: all of the ground truth
  std::string split{};     ///< split to evaluate; empty: all of the ground truth
  std::string truth_name =
      "truth";  ///< name of the ground truth in messages, such as the file name
  std::string results_name = "results";  ///< name of the results in messages
};

/// COCO mask evaluation, equal to pycocotools' COCOeval (iouType "segm"): IoU of full-size masks,
/// at most 100 results per image and class; crowds and objects of other sizes are ignored. Skips
/// results of classes and splits that are not evaluated. Results of equal score are ordered by
/// image id, then by position in the list. (One difference: pycocotools counts a hit on annotation
/// id 0 as a miss; here ids have no meaning.)
/// @throws DataError for a category or split missing in the ground truth, or a result with an
/// unknown image, a mask of a wrong size, or a score that is not a number.
SegmentationErrors segmentation_error(const CocoDataset& truth,
                                      const std::vector<CocoResult>& results,
                                      const SegmentationErrorOptions& options = {});

}  // namespace mms
