#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "mms/core/trajectory.hpp"

namespace mms {

/// The transform that takes the world of true poses to that of estimated ones, from all frames that
/// have both (`align_poses`; stamps matched as for the trajectory error). Nothing where no frame
/// has.
std::optional<Eigen::Isometry3d> align_truth(const Trajectory& truth, const Trajectory& estimate);

}  // namespace mms
