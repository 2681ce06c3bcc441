#pragma once

#include <filesystem>
#include <memory>

#include "mms/server/scene/viewer_scene.hpp"

namespace mms {

/// Opens a finished run for viewing: the results of mms run, or the journal of a killed run.
/// @throws FileError, DataError if the folder has none or a file cannot be read.
std::shared_ptr<Scene> open_recorded_scene(const std::filesystem::path& folder);

}  // namespace mms
