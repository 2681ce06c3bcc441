#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace mms {

/// Partition of points. Clusters are numbered in the order of their first points.
struct Clusters {
  static constexpr int kNone = -1;

  std::vector<int> label;  ///< cluster of every point, or kNone
  int count = 0;
};

/// Smaller and larger clusters are dropped.
struct ClusterSize {
  int min_points = 1;
  int max_points = 1 << 30;
};

/// Connected components of an organized cloud (row-major, `width` columns). Two points are linked
/// if they are grid neighbors (the 8 adjacent cells and the 4 at distance two in a row or a column,
/// which bridges single missing points) and at most the larger of their tolerances apart.
/// @param keep zero for points to ignore; NaN points are ignored as well
/// @param tolerance of every point [m]
Clusters cluster_grid(std::span<const Eigen::Vector3f> points, int width,
                      std::span<const std::uint8_t> keep, std::span<const float> tolerance,
                      const ClusterSize& size = {});

/// Euclidean clustering: connected components of points at most `tolerance` [m] apart. Linear in
/// the number of points if their density is bounded, as after `voxel_downsample`.
/// @param keep zero for points to ignore; NaN points are ignored as well
Clusters cluster_points(std::span<const Eigen::Vector3f> points, std::span<const std::uint8_t> keep,
                        float tolerance, const ClusterSize& size = {});

}  // namespace mms
