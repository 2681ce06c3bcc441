#pragma once

#include <memory>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/simulation/config/scene_config.hpp"

namespace mms {

/// Plays a warehouse scene, rendered as its frames are asked for: the very frames that a recording
/// of it by `write_simulation` holds, with its truth poses and the true map of the frames so far.
/// @param load_masks  false: frames come without masks
/// @param map_truth   false: there is no truth of map and objects, whose memory grows with the
/// frames
/// @throws ConfigError when the config asks for what cannot be.
std::unique_ptr<FrameSource> play_scene(const SceneConfig& config, bool load_masks,
                                        bool map_truth = true);

}  // namespace mms
