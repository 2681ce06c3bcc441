#pragma once

#include <memory>
#include <string>

#include "mms/segmentation/detection/detector.hpp"
#include "mms/segmentation/segmenters/segmentation_config.hpp"
#include "mms/segmentation/weights/model.hpp"

namespace mms {

/// Functions of libtorch. Programs that are linked with the library `mms_run_torch` have them,
/// others start fast and are small.
struct TorchBackend {
  bool (*has_gpu)() = nullptr;
  std::unique_ptr<Detector> (*make_detector)(const SegmentationModel& model,
                                             const std::string& where,
                                             const SegmentationConfig& config) = nullptr;
};

/// That of this program; set before main.
TorchBackend& torch_backend();

/// Whether libtorch finds a GPU; false without libtorch.
bool torch_has_gpu();

/// @throws DataError if the weights do not fit the network; Error without libtorch.
std::unique_ptr<Detector> make_torch_detector(const SegmentationModel& model,
                                              const std::string& where,
                                              const SegmentationConfig& config);

}  // namespace mms
