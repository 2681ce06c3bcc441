#pragma once

#include <cstddef>
#include <vector>

#include "mms/evaluation/segmentation/mask_matching.hpp"

namespace mms {

/// Summary of the precision-recall curve, in [0, 1].
struct PrecisionRecall {
  double precision = 0.0;  ///< average precision: mean over the recalls 0, 0.01, ..., 1
  double recall = 0.0;     ///< share of the objects that were hit
};

/// Average precision as in COCOeval.accumulate: at each of the 101 recalls the highest precision at
/// that or a higher recall, and 0 beyond the last.
/// @param verdicts  of all detections, highest score first; ignored ones have no effect
/// @param objects   number of objects that count; 0 makes both numbers NaN
PrecisionRecall average_precision(const std::vector<Verdict>& verdicts, std::size_t objects);

}  // namespace mms
