#pragma once

#include <cstddef>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/tracking/dynamic_map.hpp"

namespace mms {

/// Takes out of P_S what is where an object was expected, but not seen: the network misses a person
/// for some frames, whom the static map would keep. The static points in the boxes of those
/// `objects` that coast become dynamic ones of no cluster; the floor they stand on stays.
///
/// @return  points that became dynamic
std::size_t mask_unseen_objects(const std::vector<TrackedObject>& objects,
                                const Transform<World, Sensor>& T_world_sensor,
                                LabeledCloud& cloud);

}  // namespace mms
