#pragma once

#include <vector>

#include "mms/mapping/static_map/map_cloud.hpp"
#include "mms/pipeline/frame_result.hpp"
#include "mms/pipeline/mapping.hpp"
#include "mms/pipeline/session_places.hpp"

namespace mms {

/// Places of all sessions of a run up to a frame, as loop closure knew them then.
std::vector<SessionPlace> places_at(const FrameResult& frame);

/// The static map as known at a frame, in the world frame of its session: the sessions whose place
/// is known, corrected by the loops so far. Where the place of the frame's session is not known,
/// the map of that session alone.
/// @param mapping  after the frame
MapCloud live_map(const Mapping& mapping, const FrameResult& frame);

}  // namespace mms
