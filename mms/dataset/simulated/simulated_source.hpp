#pragma once

#include <memory>
#include <string_view>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

struct SceneConfig;

/// Whether the address is a simulation ("sim:...") instead of a recording on disk.
bool is_simulated(std::string_view address);

/// The scene of an address: "sim:warehouse_loop" or another of scene_names(), optionally with
/// fields of SceneConfig, as in "sim:crowd?seed=3&sensor=d435&mask_errors.enabled=true".
/// @throws DataError for an unknown scene or key (with the closest known ones), or a value of a
/// wrong type or out of range.
SceneConfig simulated_scene(std::string_view address);

/// Opens a simulation, which renders frames on request, with masks and ground-truth poses.
/// @throws DataError as `simulated_scene`, or for a mask folder in the options.
std::unique_ptr<FrameSource> open_simulated(std::string_view address,
                                            const SourceOptions& options = {});

}  // namespace mms
