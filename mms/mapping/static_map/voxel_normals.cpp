#include "mms/mapping/static_map/voxel_normals.hpp"

#include <Eigen/Eigenvalues>

namespace mms {
namespace {

/// Sums for the covariance of the means around a voxel, relative to its own.
struct Spread {
  int count = 0;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();

  void add(const Eigen::Vector3f& offset) {
    ++count;
    sum += offset;
    squares += offset * offset.transpose();
  }
  Eigen::Matrix3f covariance() const {
    const auto n = static_cast<float>(count);
    return squares / n - (sum / n) * (sum / n).transpose();
  }
};

Spread neighbourhood(const VoxelGrid& grid, const VoxelKey& center, const Voxel& voxel) {
  Spread spread;
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const Voxel* other = grid.find({center.x + x, center.y + y, center.z + z});
        if (other != nullptr) spread.add(other->position - voxel.position);
      }
    }
  }
  return spread;
}

}  // namespace

Eigen::Vector3f neighbourhood_normal(const VoxelGrid& grid, const VoxelBlock& block,
                                     const Voxel& voxel, const Eigen::Vector3f& viewpoint) {
  const Spread spread = neighbourhood(grid, block.voxel_key(voxel), voxel);
  if (spread.count < 4) return Eigen::Vector3f::Zero();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(spread.covariance());
  const Eigen::Vector3f values = solver.eigenvalues();
  // A line of points, as one LiDAR ring leaves it, has no normal; nor has a blob.
  if (values(1) < 0.05F * values(2) || values(0) > 0.5F * values(1)) return Eigen::Vector3f::Zero();
  const Eigen::Vector3f normal = solver.eigenvectors().col(0);
  return normal.dot(viewpoint - voxel.position) < 0.0F ? Eigen::Vector3f(-normal) : normal;
}

}  // namespace mms
