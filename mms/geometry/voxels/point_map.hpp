#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/geometry/voxels/voxel_hash_map.hpp"

namespace mms {

/// A map point and its squared distance [m^2] to the query.
struct Neighbor {
  Eigen::Vector3f point;
  float squared_distance = 0.0F;
};

/// Incremental point cloud with k-nearest-neighbor and radius search. A voxel keeps at most
/// `max_points_per_voxel` points at least `min_spacing` apart, so density and memory are bounded.
class PointMap {
 public:
  struct Limits {
    int max_points_per_voxel = 20;
    float min_spacing = 0.0F;  ///< [m]
    std::size_t max_voxels = 1'000'000;
  };

  PointMap(double voxel_size, const Limits& limits);

  /// Adds the finite points; ignores the others.
  void insert(const std::vector<Eigen::Vector3f>& points);

  /// Up to `k` nearest points within `max_distance` [m], nearest first; ties by coordinates.
  void nearest(const Eigen::Vector3f& query, std::size_t k, float max_distance,
               std::vector<Neighbor>& result) const;

  /// All points within `radius` [m], nearest first; ties by coordinates.
  void within(const Eigen::Vector3f& query, float radius, std::vector<Neighbor>& result) const;

  void remove_farther_than(const Eigen::Vector3f& centre, float distance);
  void clear() { voxels_.clear(); }

  std::size_t size() const;
  bool empty() const { return voxels_.empty(); }
  std::vector<Eigen::Vector3f> points() const;

 private:
  using Cell = std::vector<Eigen::Vector3f>;

  void add(const Eigen::Vector3f& point);

  Limits limits_;
  VoxelHashMap<Cell> voxels_;
};

}  // namespace mms
