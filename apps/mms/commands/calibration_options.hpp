#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "mms/dataset/source/camera_options.hpp"

namespace mms {

/// Adds the options for a calibration in place of the recording's: --calibration, --intrinsics,
/// --depth-scale.
void add_calibration_options(CLI::App& command, CameraOptions& options);

/// Adds --depth-scale.
/// @param scale  unchanged by default
CLI::Option* add_depth_scale_option(CLI::App& command, std::optional<double>& scale);

/// Adds --rate.
void add_rate_option(CLI::App& command, std::optional<double>& rate);

}  // namespace mms
