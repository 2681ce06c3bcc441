#include "mms/mapping/static_map/voxel_normals.hpp"

#include "mms/geometry/principal_axes.hpp"

namespace mms {
namespace {

/// [-]: neighbours of a plane. Source: one more than three points, which always have a plane.
constexpr int kMinNeighbors = 4;

/// [-]: least second largest variance, relative to the largest. Source: below it the points are a
/// line, as of one LiDAR ring.
constexpr float kMinMiddleVariance = 0.05F;

/// [-]: largest variance across the plane, relative to the second largest. Source: above it the
/// points are as thick as wide.
constexpr float kMaxThickness = 0.5F;

/// Sums over the means around a voxel, relative to its own.
PointSums<float, 3> neighbourhood(const VoxelGrid& grid, const VoxelKey& center,
                                  const Voxel& voxel) {
  PointSums<float, 3> offsets;
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const Voxel* other = grid.find({center.x + x, center.y + y, center.z + z});
        if (other != nullptr) offsets.add(other->position - voxel.position);
      }
    }
  }
  return offsets;
}

}  // namespace

Eigen::Vector3f neighbourhood_normal(const VoxelGrid& grid, const VoxelBlock& block,
                                     const Voxel& voxel, const Eigen::Vector3f& viewpoint) {
  const PointSums<float, 3> offsets = neighbourhood(grid, block.voxel_key(voxel), voxel);
  if (offsets.count() < kMinNeighbors) return Eigen::Vector3f::Zero();
  const auto axes = principal_axes(offsets.covariance(), EigenMethod::kClosedForm);
  const Eigen::Vector3f& values = axes.variances;
  const bool is_line = values(1) < kMinMiddleVariance * values(2);
  if (is_line || values(0) > kMaxThickness * values(1)) return Eigen::Vector3f::Zero();
  const Eigen::Vector3f to_viewpoint = viewpoint - voxel.position;
  return oriented(axes.smallest(), to_viewpoint);
}

}  // namespace mms
