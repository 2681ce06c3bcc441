#pragma once

#include <memory>

#include "mms/dataset/frame_source.hpp"
#include "mms/simulation/simulated_room.hpp"

namespace mms {

/// Plays a furnished room with exact masks and poses.
/// @param load_masks  false: frames come without masks
std::unique_ptr<FrameSource> play_room(const RoomConfig& config, bool load_masks);

}  // namespace mms
