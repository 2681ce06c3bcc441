#pragma once

#include <cstddef>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/tracking/dynamic_map.hpp"

namespace mms {

/// Removes from P_S the points where an object is predicted but not seen: the network misses a
/// person for some frames, who would enter the static map. The static points in the boxes of
/// coasting `objects` become dynamic points without a cluster; the floor below them stays static.
///
/// @return  points that became dynamic
std::size_t mask_unseen_objects(const std::vector<TrackedObject>& objects,
                                const Transform<World, Sensor>& T_world_sensor,
                                LabeledCloud& cloud);

}  // namespace mms
