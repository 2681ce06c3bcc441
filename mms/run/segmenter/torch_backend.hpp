#pragma once

#include <memory>
#include <string>

#include "mms/segmentation/detection/detector.hpp"
#include "mms/segmentation/segmenters/segmentation_config.hpp"
#include "mms/segmentation/weights/model.hpp"

namespace mms {

// Functions that need libtorch. Two libraries define them: `mms_run_torch` with libtorch, and
// `mms_run_no_torch`, which throws, for fast start and small size.

/// Whether libtorch finds a GPU; false without libtorch.
bool torch_has_gpu();

/// @throws DataError if the weights do not fit the network; Error without libtorch.
std::unique_ptr<Detector> make_torch_detector(const SegmentationModel& model,
                                              const std::string& where,
                                              const SegmentationConfig& config);

}  // namespace mms
