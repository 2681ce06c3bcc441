#pragma once

#include <cstdint>
#include <vector>

#include "mms/pipeline/correction_feed.hpp"
#include "mms/server/scene/scene_data.hpp"

namespace mms {

/// Moves the pose and the objects of a displayed frame as loops correct them, to the world frame of
/// the present pose, which therefore does not move. A frame whose place is not known stays.
/// @param session  of the frame
/// @param before   by which the frame was moved already; null for none
void correct_frame(SceneFrame& frame, std::uint32_t session, const MapCorrection* before,
                   const MapCorrection& now);

/// The loops between frames that are displayed.
/// @param stamps  of the frames
std::vector<SceneLoop> loops_between(const std::vector<Timestamp>& stamps,
                                     const std::vector<ClosedLoop>& loops);

}  // namespace mms
