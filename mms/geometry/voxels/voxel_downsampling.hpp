#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace mms {

/// A cloud thinned to one point a voxel.
struct VoxelDownsampled {
  static constexpr int kNone = -1;

  std::vector<Eigen::Vector3f> points;  ///< means, in the order of their voxels' first points [m]
  std::vector<int> voxel;  ///< of every input point, kNone for those that are not finite
};

/// Mean of the finite points of every cubic voxel of side `size` [m].
VoxelDownsampled voxel_downsample(std::span<const Eigen::Vector3f> points, float size);

}  // namespace mms
