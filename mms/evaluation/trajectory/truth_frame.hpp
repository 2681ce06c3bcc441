#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "mms/core/trajectory.hpp"

namespace mms {

/// Transform from the world frame of the ground-truth poses to that of the estimated ones, from all
/// matched frames (`align_poses`; stamps matched as for the trajectory error). nullopt if no frame
/// matches.
std::optional<Eigen::Isometry3d> align_truth(const Trajectory& truth, const Trajectory& estimate);

}  // namespace mms
