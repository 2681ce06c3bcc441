#pragma once

#include "mms/core/object_box.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"

namespace mms {

/// The paper's picture of the final map: the static map with every object of a run in it, as the
/// edges of its box where it was last seen and as the way it went, with gaps where it was unseen.
/// People are red, vehicles green.
/// @param map      world frame; its points come first in the result
/// @param spacing  of the points that edges and ways are drawn with [m], > 0
MapCloud semantic_map(MapCloud map, const ObjectHistory& history, double spacing = 0.02);

}  // namespace mms
