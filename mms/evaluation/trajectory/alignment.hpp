#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace mms {

/// Rigid transform T that minimises the sum of |target_i - T source_i|^2, without scale
/// (Umeyama, PAMI 1991). Parallel vectors, points in metres. For positions on one line or in one
/// point the rotation is not unique; the residual is the smallest possible all the same.
/// @throws DataError for fewer than three pairs or vectors of different length
Eigen::Isometry3d align_points(const std::vector<Eigen::Vector3d>& source,
                               const std::vector<Eigen::Vector3d>& target);

/// Rigid transform T for which the poses T * source_i come nearest to target_i: the mean of their
/// rotations (chordal), then the mean of the positions. Unlike `align_points` it is unique for
/// sensors that stand still or drive straight on, as the frames of maps need.
/// @throws DataError for no pair or vectors of different length
Eigen::Isometry3d align_poses(const std::vector<Eigen::Isometry3d>& source,
                              const std::vector<Eigen::Isometry3d>& target);

}  // namespace mms
