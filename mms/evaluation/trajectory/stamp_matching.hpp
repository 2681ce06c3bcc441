#pragma once

#include <cstddef>
#include <vector>

#include "mms/core/trajectory.hpp"

namespace mms {

/// Indices of two simultaneous poses, one in each trajectory.
struct PoseMatch {
  std::size_t reference = 0;
  std::size_t estimate = 0;

  bool operator==(const PoseMatch&) const = default;
};

/// Pairs every estimated pose with the reference pose nearest in time, at most `max_difference`
/// [ns] apart (inclusive). One to one: of several estimated poses nearest to the same reference
/// pose, the nearest one (the first of equals) is matched. The trajectories need not be sorted;
/// poses with NaN or infinite numbers are ignored. @return in the order of the estimate's stamps
std::vector<PoseMatch> match_by_stamp(const Trajectory& reference, const Trajectory& estimate,
                                      Duration max_difference);

/// Pairs frame i with frame i, for KITTI files without stamps. Frames without counterpart and poses
/// with NaN or infinite numbers are ignored.
std::vector<PoseMatch> match_by_index(const Trajectory& reference, const Trajectory& estimate);

}  // namespace mms
