#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace mms {

/// A cloud downsampled to one point per voxel.
struct VoxelDownsampled {
  static constexpr int kNone = -1;

  std::vector<Eigen::Vector3f>
      points;              ///< means, in the order of the first points of the voxels [m]
  std::vector<int> voxel;  ///< voxel of every input point, kNone for non-finite points
};

/// Means of the finite points per cubic voxel of side `size` [m].
VoxelDownsampled voxel_downsample(std::span<const Eigen::Vector3f> points, float size);

}  // namespace mms
