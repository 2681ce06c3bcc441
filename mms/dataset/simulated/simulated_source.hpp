#pragma once

#include <memory>
#include <string_view>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

struct SceneConfig;

/// Whether the address names a simulation ("sim:...") and not a recording on disk.
bool is_simulated(std::string_view address);

/// The scene that an address names: "sim:warehouse_loop" or another of scene_names(), or with any
/// fields of SceneConfig "sim:crowd?seed=3&sensor=d435&mask_errors.enabled=true".
/// @throws DataError for another scene or an unknown key (naming the nearest known ones), or a
///         value that is not of the key's type or out of its range.
SceneConfig simulated_scene(std::string_view address);

/// Opens a simulation, which renders its frames as they are asked for, with masks and truth poses.
/// @throws DataError as `simulated_scene`, or for a folder of masks in the options.
std::unique_ptr<FrameSource> open_simulated(std::string_view address,
                                            const SourceOptions& options = {});

}  // namespace mms
