#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mms {

/// Pairs of points that may be the same, in two frames. The vectors are parallel.
struct PointPairs {
  std::vector<Eigen::Vector3d> a;  ///< [m]
  std::vector<Eigen::Vector3d> b;  ///< [m]
  std::vector<double> sigma;       ///< standard deviation of the distance of a pair [m]
};

/// A rigid transform that most pairs agree with.
struct PointAlignment {
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  std::vector<std::size_t> inliers;  ///< indices of the pairs within three sigma, ascending
};

/// RANSAC over three pairs (Fischler and Bolles, 1981), then least squares over the inliers
/// (Umeyama, PAMI 1991). Equal for equal arguments.
/// @returns nothing if no transform has four inliers
std::optional<PointAlignment> align_points(const PointPairs& pairs, std::uint64_t seed);

/// Indices of the pairs within three sigma by a transform, ascending.
std::vector<std::size_t> inliers_of(const PointPairs& pairs, const Eigen::Isometry3d& T_a_b);

/// Least squares over the pairs that agree with a transform that is roughly known.
PointAlignment refine_alignment(const PointPairs& pairs, const Eigen::Isometry3d& T_a_b);

}  // namespace mms
