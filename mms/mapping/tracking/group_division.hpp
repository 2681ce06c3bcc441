#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/ground/ground_frame.hpp"
#include "mms/mapping/tracking/track_config.hpp"

namespace mms {

/// The clusters of a cloud, those of several objects divided into parts.
struct ClusterParts {
  std::vector<std::int16_t> part;    ///< of every point, -1 for none
  std::vector<std::size_t> cluster;  ///< cluster of each part, in the order of the clusters
};

/// Divides clusters whose extent over the floor exceeds one object of their class: people behind
/// each other who share a mask. K-means on the floor (Lloyd 1982) gives the fewest parts that are
/// small enough, at most four; a few points are a stray end of an object, not a part. Clusters
/// without points are one part.
ClusterParts divide_groups(const LabeledCloud& cloud,
                           const Transform<World, Sensor>& T_world_sensor,
                           const GroundFrame& ground, const TrackConfig& config);

}  // namespace mms
