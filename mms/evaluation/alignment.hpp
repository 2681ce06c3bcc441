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

}  // namespace mms
