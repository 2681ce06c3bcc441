#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace mms {

/// Partition of points: clusters are numbered in the order of their first points.
struct Clusters {
  static constexpr int kNone = -1;

  std::vector<int> label;  ///< cluster of every point, kNone for those in none
  int count = 0;
};

/// Smaller and larger clusters are dropped.
struct ClusterSize {
  int min_points = 1;
  int max_points = 1 << 30;
};

/// Connected components of an organised cloud (row-major, `width` columns). Two points are linked
/// when they are neighbours in the grid (the 8 next cells and the 4 at distance two in a row or a
/// column, which bridges single holes) and at most the larger of their tolerances apart.
/// @param keep       zero for points that belong to no cluster; NaN points belong to none either
/// @param tolerance  of every point [m]
Clusters cluster_grid(std::span<const Eigen::Vector3f> points, int width,
                      std::span<const std::uint8_t> keep, std::span<const float> tolerance,
                      const ClusterSize& size = {});

/// Euclidean clusters: components of the graph that links points at most `tolerance` [m] apart.
/// Linear in the number of points when their density is bounded, as after `voxel_downsample`.
/// @param keep  zero for points that belong to no cluster; NaN points belong to none either
Clusters cluster_points(std::span<const Eigen::Vector3f> points, std::span<const std::uint8_t> keep,
                        float tolerance, const ClusterSize& size = {});

}  // namespace mms
