#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace mms {

/// Rigid transform T that minimizes the sum of |target_i - T source_i|^2, without scale (Umeyama,
/// PAMI 1991). Parallel vectors, points in meters. For collinear or identical positions the
/// rotation is not unique, but the residual is minimal.
/// @throws DataError for fewer than three pairs or vectors of different size
Eigen::Isometry3d align_points(const std::vector<Eigen::Vector3d>& source,
                               const std::vector<Eigen::Vector3d>& target);

/// Rigid transform T that aligns the poses T * source_i with target_i: the mean of their rotations
/// (chordal), then the mean of the positions. Unlike `align_points` it is unique for static sensors
/// and straight trajectories, as needed for maps.
/// @throws DataError for no pair or vectors of different size
Eigen::Isometry3d align_poses(const std::vector<Eigen::Isometry3d>& source,
                              const std::vector<Eigen::Isometry3d>& target);

}  // namespace mms
