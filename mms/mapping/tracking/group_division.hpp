#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/ground/ground_frame.hpp"
#include "mms/mapping/tracking/track_config.hpp"

namespace mms {

/// The clusters of a cloud, those that hold several objects divided.
struct ClusterParts {
  std::vector<std::int16_t> part;    ///< of every point, -1 for none
  std::vector<std::size_t> cluster;  ///< that each part is of, in the order of the clusters
};

/// Divides clusters that reach farther over the floor than one object of their class can: people
/// before each other who share a mask. Into as few parts about means on the floor (Lloyd 1982) as
/// are small enough, at most four; few points are a stray end of an object, not a part of their
/// own. Clusters without points of theirs are one part.
ClusterParts divide_groups(const LabeledCloud& cloud,
                           const Transform<World, Sensor>& T_world_sensor,
                           const GroundFrame& ground, const TrackConfig& config);

}  // namespace mms
