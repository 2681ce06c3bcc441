#pragma once

#include <filesystem>
#include <string>

#include "mms/simulation/config/scene_config.hpp"

namespace mms {

/// Makes the folder ready for the recording of a simulated scene and writes its scene.yaml, from
/// which the same recording can be made again. The files of a simulation that was there before are
/// removed.
/// @throws FileError when the folder cannot be made, written to, or holds anything other than such
///         a simulation.
void prepare_recording_folder(const std::filesystem::path& folder, const SceneConfig& config);

/// The documented YAML of a scene, as scene.yaml holds it.
std::string scene_yaml(const SceneConfig& config);

}  // namespace mms
