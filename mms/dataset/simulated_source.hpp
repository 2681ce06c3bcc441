#pragma once

#include <memory>
#include <string_view>

#include "mms/dataset/frame_source.hpp"
#include "mms/dataset/source_options.hpp"

namespace mms {

/// Whether the address names a simulation ("sim:...") and not a recording on disk.
bool is_simulated(std::string_view address);

/// Opens a simulation, which renders its frames as they are asked for, with masks and truth poses:
/// "sim:warehouse_loop" or another of scene_names(), or with any fields of SceneConfig
/// "sim:crowd?seed=3&sensor=d435&mask_errors.enabled=true".
/// @throws DataError for another scene or an unknown key (naming the nearest known ones), a value
///         that is not of the key's type or out of its range, or a folder of masks in the options.
std::unique_ptr<FrameSource> open_simulated(std::string_view address,
                                            const SourceOptions& options = {});

}  // namespace mms
