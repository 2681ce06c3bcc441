#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/server/scene/viewer_scene.hpp"

namespace mms {

/// Opens a finished run for viewing: the results of mms run, or the journal of a killed run.
/// @param warnings  of files that are left out as they cannot be read
/// @throws FileError, DataError if the folder has none, or its poses cannot be read.
std::shared_ptr<Scene> open_recorded_scene(const std::filesystem::path& folder,
                                           std::vector<std::string>& warnings);

/// Shows in the scene of a live run its final poses, objects, map and loops.
/// @param folder  with the results of all its frames
/// @throws as `open_recorded_scene`
void show_final_results(const std::filesystem::path& folder, Scene& scene);

}  // namespace mms
