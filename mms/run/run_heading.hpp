#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/run/record/run_options.hpp"

namespace mms {

/// What a run works on, in three lines: the recording and its layout, the sensor and the source of
/// the masks, and the folder of the results.
/// @param frames  number of frames to process
std::vector<std::string> run_heading(const RunOptions& options, const FrameSource& source,
                                     const SystemConfig& config, std::size_t frames,
                                     const std::filesystem::path& folder);

}  // namespace mms
