#pragma once

#include <memory>
#include <string>

#include "mms/segmentation/detection/detector.hpp"
#include "mms/segmentation/segmenters/segmentation_config.hpp"
#include "mms/segmentation/weights/model.hpp"

namespace mms {

// What takes libtorch. Two libraries define it: `mms_run_torch` on libtorch, and
// `mms_run_no_torch`, which refuses, for programs that start at once and fit on a robot.

/// Whether libtorch finds a GPU; false without it.
bool torch_has_gpu();

/// @throws DataError when the weights do not fit the network; Error without libtorch.
std::unique_ptr<Detector> make_torch_detector(const SegmentationModel& model,
                                              const std::string& where,
                                              const SegmentationConfig& config);

}  // namespace mms
