#pragma once

#include <vector>

#include "mms/core/config.hpp"
#include "mms/mapping/track.hpp"

namespace mms {

struct AssociationConfig {
  double gate_radius = 0.8;  ///< [m]
  double max_speed = 3.0;    ///< [m/s]

  void visit(ConfigVisitor& v) {
    v.number({"gate_radius", "m", "farthest an object may be from where its track expects it"},
             gate_radius, {0.01, 100.0});
    v.number({"max_speed", "m/s", "fastest object"}, max_speed, {0.1, 100.0});
  }
};

/// Index of the track each object continues, -1 for none: the nearest pairs first, no track twice.
/// A pair has to be within the gate of the track's prediction and within what the fastest object
/// covers (plus the gate, since a centroid jumps when part of a body is hidden). Tracks that ended
/// take no part.
std::vector<int> associate(const std::vector<Track>& tracks,
                           const std::vector<ObjectObservation>& objects,
                           const AssociationConfig& config);

}  // namespace mms
