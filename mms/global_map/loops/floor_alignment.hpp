#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mms {

/// A rigid transform along the floor that most pairs of places agree with.
struct FloorAlignment {
  Eigen::Isometry2d T_a_b = Eigen::Isometry2d::Identity();
  std::vector<std::size_t> inliers;  ///< indices of the pairs, ascending
};

/// RANSAC over two pairs (Fischler and Bolles, 1981), then least squares over the inliers. Equal
/// for equal arguments.
/// @param a, b       places that may be the same, in two frames; of equal size [m]
/// @param tolerance  largest distance of the places of an inlier [m]
/// @returns nothing if no transform has three inliers
std::optional<FloorAlignment> align_on_floor(const std::vector<Eigen::Vector2d>& a,
                                             const std::vector<Eigen::Vector2d>& b,
                                             double tolerance, std::uint64_t seed);

}  // namespace mms
