#pragma once

#include <memory>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/simulation/config/scene_config.hpp"

namespace mms {

/// Plays a warehouse scene and renders frames on request: the same frames as in a recording by
/// `write_simulation`, with ground-truth poses and the ground-truth map of the frames so far.
/// @param load_masks  false: frames come without masks
/// @param map_truth   false: no ground truth of map and objects, whose memory grows with the frames
/// @throws ConfigError for an invalid config.
std::unique_ptr<FrameSource> play_scene(const SceneConfig& config, bool load_masks,
                                        bool map_truth = true);

}  // namespace mms
