#pragma once

#include <cstddef>
#include <vector>

#include "mms/evaluation/segmentation/mask_matching.hpp"

namespace mms {

/// The curve of precision against recall in two numbers in [0, 1].
struct PrecisionRecall {
  double precision = 0.0;  ///< average precision: the mean over the recalls 0, 0.01, ..., 1
  double recall = 0.0;     ///< share of the objects that were hit at all
};

/// COCO's average precision, as in COCOeval.accumulate: at each of the 101 recalls the highest
/// precision of that recall or a higher one, and 0 beyond the last.
/// @param verdicts  on all detections, the highest score first; ignored ones make no difference
/// @param objects   number of objects that count; with none both numbers are NaN
PrecisionRecall average_precision(const std::vector<Verdict>& verdicts, std::size_t objects);

}  // namespace mms
