#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "mms/segmentation/detector.hpp"
#include "mms/segmentation/model.hpp"
#include "mms/segmentation/segmentation_config.hpp"

namespace mms {

// What takes libtorch. The program is linked twice: `mms` without it, which starts at once and fits
// on a robot, and `mms-torch` with it, which has all commands of the other.

/// Whether libtorch finds a GPU; false without it.
bool torch_has_gpu();

/// @throws DataError when the weights do not fit the network; Error without libtorch.
std::unique_ptr<Detector> make_torch_detector(const SegmentationModel& model,
                                              const std::string& where,
                                              const SegmentationConfig& config);

/// Adds `mms train`; without libtorch it hands over to `mms-torch` beside this program.
void add_train_command(CLI::App& app);

}  // namespace mms
