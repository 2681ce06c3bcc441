#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <set>

#include "mms/core/trajectory.hpp"

namespace mms {

/// Transform from the world frame of the ground-truth poses to that of the estimated ones, from all
/// matched frames (`align_poses`; stamps matched as for the trajectory error). nullopt if no frame
/// matches.
std::optional<Eigen::Isometry3d> align_truth(const Trajectory& truth, const Trajectory& estimate);

/// The poses of other stamps. For `align_truth` without lost frames: their poses are predictions,
/// and their points are not in the map.
Trajectory poses_without(Trajectory poses, const std::set<Timestamp>& left_out);

}  // namespace mms
