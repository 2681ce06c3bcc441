#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/pipeline/correction_feed.hpp"
#include "mms/server/scene/scene_data.hpp"

namespace mms {

/// Frames of a live run with poses and objects as loops correct them, in the world frame of the
/// present pose, which therefore does not move. Frames whose place is not known stay as they are.
/// @param shown      of which the first `corrected` were moved by `before` already
/// @param sessions   by frame
/// @param now        of the present frame
SceneFrames corrected_frames(const SceneFrames& shown, const std::vector<std::uint32_t>& sessions,
                             const MapCorrection& before, std::size_t corrected,
                             const MapCorrection& now);

/// The loops between frames that are shown.
std::vector<SceneLoop> loops_between(const SceneFrames& frames,
                                     const std::vector<ClosedLoop>& loops);

}  // namespace mms
