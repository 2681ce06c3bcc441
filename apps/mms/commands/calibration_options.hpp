#pragma once

#include <CLI/CLI.hpp>

#include "mms/dataset/source/camera_options.hpp"

namespace mms {

/// Adds the options for a calibration in place of the recording's: --calibration, --intrinsics,
/// --depth-scale.
void add_calibration_options(CLI::App& command, CameraOptions& options);

}  // namespace mms
