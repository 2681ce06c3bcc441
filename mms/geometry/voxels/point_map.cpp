#include "mms/geometry/voxels/point_map.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace mms {
namespace {

bool closer(const Neighbor& a, const Neighbor& b) {
  return std::tie(a.squared_distance, a.point.x(), a.point.y(), a.point.z()) <
         std::tie(b.squared_distance, b.point.x(), b.point.y(), b.point.z());
}

}  // namespace

PointMap::PointMap(double voxel_size, const Limits& limits)
    : limits_(limits), voxels_(voxel_size, limits.max_voxels) {}

void PointMap::insert(const std::vector<Eigen::Vector3f>& points) {
  for (const Eigen::Vector3f& point : points) {
    if (point.allFinite()) add(point);
  }
  voxels_.enforce_bound();
}

void PointMap::add(const Eigen::Vector3f& point) {
  Cell& cell = voxels_.touch(voxels_.key(point));
  if (cell.size() >= static_cast<std::size_t>(limits_.max_points_per_voxel)) return;
  const float spacing2 = limits_.min_spacing * limits_.min_spacing;
  const bool crowded = std::any_of(cell.begin(), cell.end(), [&](const Eigen::Vector3f& other) {
    return (other - point).squaredNorm() < spacing2;
  });
  if (!crowded) cell.push_back(point);
}

void PointMap::within(const Eigen::Vector3f& query, float radius,
                      std::vector<Neighbor>& result) const {
  result.clear();
  const VoxelKey low = voxels_.key(query - Eigen::Vector3f::Constant(radius));
  const VoxelKey high = voxels_.key(query + Eigen::Vector3f::Constant(radius));
  voxels_.for_each_in(low, high, [&](const Cell& cell) {
    for (const Eigen::Vector3f& point : cell) {
      const float distance2 = (point - query).squaredNorm();
      if (distance2 <= radius * radius) result.push_back({point, distance2});
    }
  });
  std::sort(result.begin(), result.end(), closer);
}

void PointMap::nearest(const Eigen::Vector3f& query, std::size_t k, float max_distance,
                       std::vector<Neighbor>& result) const {
  // Most queries succeed within the smaller radius; only sparse regions need the full one.
  const float first = std::min(max_distance, 0.5F * voxels_.voxel_size());
  within(query, first, result);
  if (result.size() < k && first < max_distance) within(query, max_distance, result);
  if (result.size() > k) result.resize(k);
}

void PointMap::remove_farther_than(const Eigen::Vector3f& centre, float distance) {
  voxels_.remove_farther_than(centre, distance);
}

std::size_t PointMap::size() const {
  std::size_t count = 0;
  for (const auto& entry : voxels_.entries()) count += entry.cell.size();
  return count;
}

std::vector<Eigen::Vector3f> PointMap::points() const {
  std::vector<Eigen::Vector3f> all;
  for (const auto& entry : voxels_.entries()) {
    all.insert(all.end(), entry.cell.begin(), entry.cell.end());
  }
  return all;
}

}  // namespace mms
