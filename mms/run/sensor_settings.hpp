#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/run/record/run_options.hpp"

namespace mms {

/// The settings for a sensor: the defaults, with those of a file, with single ones.
/// @param calibration  of the sensor, whose largest depth is a default; may be null
/// @param file         YAML; empty: none
/// @param assignments  "group.key=value"
/// @param where        source of the assignments, for messages
/// @param warnings     receives a line for each setting under a former name
/// @throws FileError, ConfigError, DataError as `load_config` and `assign`
SystemConfig sensor_settings(const Calibration* calibration, const std::filesystem::path& file,
                             std::span<const std::string> assignments, const std::string& where,
                             std::vector<std::string>& warnings);

/// The settings with the options of a run that replace some of them: network, fusion and loops.
/// @throws FileError if the network has a name and is not there
SystemConfig with_options(SystemConfig config, const RunOptions& options);

}  // namespace mms
