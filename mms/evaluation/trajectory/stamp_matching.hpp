#pragma once

#include <cstddef>
#include <vector>

#include "mms/core/trajectory.hpp"

namespace mms {

/// Positions of two poses, one in each trajectory, that are of the same instant.
struct PoseMatch {
  std::size_t reference = 0;
  std::size_t estimate = 0;

  bool operator==(const PoseMatch&) const = default;
};

/// Pairs every estimated pose with the reference pose nearest in time, where they are at most
/// `max_difference` [ns] apart (inclusive). One to one: of several estimated poses that are nearest
/// to the same reference pose, the nearest one (the first of equals) is matched and the others stay
/// unmatched. The trajectories need not be sorted; poses with NaN or infinite numbers never match.
/// @return in the order of the estimate's stamps
std::vector<PoseMatch> match_by_stamp(const Trajectory& reference, const Trajectory& estimate,
                                      Duration max_difference);

/// Pairs frame i with frame i, as KITTI's files without stamps need it; frames that only one of the
/// two has, and poses with NaN or infinite numbers, stay unmatched.
std::vector<PoseMatch> match_by_index(const Trajectory& reference, const Trajectory& estimate);

}  // namespace mms
