#pragma once

#include "mms/core/object_box.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"

namespace mms {

/// The paper's picture of the final map: the static map with every object of a run, drawn as the
/// edges of its last box and its trajectory, with gaps where it was unseen. People are red,
/// vehicles green, unknown objects amber.
/// @param map      world frame; its points come first in the result
/// @param spacing  distance between the points of edges and trajectories [m], > 0
MapCloud semantic_map(MapCloud map, const ObjectHistory& history, double spacing = 0.02);

}  // namespace mms
