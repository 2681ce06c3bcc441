#pragma once

#include <filesystem>
#include <string>

#include "mms/simulation/config/scene_config.hpp"

namespace mms {

/// Prepares the folder for the recording of a simulated scene and writes its scene.yaml, from which
/// the recording can be recreated.
/// @param overwrite  removes the files of an earlier simulation
/// @throws FileError if the folder cannot be created or written, has an earlier simulation without
/// `overwrite`, or contains anything other than a simulation.
void prepare_recording_folder(const std::filesystem::path& folder, const SceneConfig& config,
                              bool overwrite);

/// YAML of a scene with descriptions, as in scene.yaml.
std::string scene_yaml(const SceneConfig& config);

}  // namespace mms
