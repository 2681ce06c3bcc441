#pragma once

#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/track.hpp"

namespace mms {

/// The clusters of `cloud` in the world frame. Boxes are of the clusters' points where the cloud
/// has them; else of the corners of the sensor frame's boxes, which are then larger.
std::vector<ObjectObservation> observe_objects(const LabeledCloud& cloud,
                                               const Transform<World, Sensor>& T_world_sensor);

}  // namespace mms
